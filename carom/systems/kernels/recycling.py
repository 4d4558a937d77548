"""Recycling: contacts of pairs that hardly move against each other go with their shapes instead of being found anew.

What detection finds changes its mind about which corners and edges stand for two faces as often as rounding does. What
stays where it is keeps its points, which is what lets piles come to rest (and costs less).
"""

from __future__ import annotations

from math import pi

import numpy as np

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.ecs.entity import INDEX_MASK
from carom.systems.constants import LEANING, REACH_KEPT, RECYCLED_SLIP, RECYCLED_TURN
from carom.systems.kernels.crew import part_of, shared, wait_for_all
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_columns import ALL, load_flat, load_three, store_flat
from carom.systems.kernels.lanes import WIDTH, address, larger, spread, which
from carom.systems.kernels.narrow import is_ball
from carom.systems.kernels.offsets import find_offsets, is_alike
from carom.systems.kernels.shares import is_flat_where_seated, share_of_b
from carom.systems.kernels.spatial import turn
from carom.systems.kernels.unrolling import roll_back, rolls

PLACED = 8  # numbers of a contact that is placed


@woven
def form_of_pair(a, b, shape, size, geometry):
    """Return a number that changes with any shape or size: a polynomial of them in pi, which is no root of others."""
    form = 0.0
    for i in (a, b):
        form = (form * pi + shape[i]) * pi + geometry[i]
        for k in range(size.shape[1]):
            form = form * pi + size[i, k]
    return form


@shared(
    "moved", "moved_reaches", "row_a", "row_b", "normal", "depth", "point", "offset_a", "offset_b", "share",
    "seat_a", "seat_b", "lean_a", "lean_b", "kept", "ends",
    makes_arrays=True,
)  # fmt: skip
def recycle_contacts(
    crew, pairs, reaches, known, old_count, handles, row_shift,
    shape, size, geometry, bound_half, bound_radius, position, rotation, body_row, center,
    a, b, seat_a, seat_b, lean_a, lean_b, seat_depth, seat_reach, form,
    moved, moved_reaches, row_a, row_b, normal, depth, point, offset_a, offset_b, share, kept, ends,
):  # fmt: skip
    """Place the contacts of all pairs that have hardly moved where their shapes are now; write which pairs have moved.

    Moved has a pair of which one is a ball, which rolls, one of whose points has slipped or sunk by RECYCLED_SLIP
    of the smaller shape, of which one shape has turned against the other, or is another, unless all are ``known``
    to be what they were, or that reaches farther by as much, so that it may have more: its contacts stay as they
    are. Those of balls are found up to where they leave (REACH_KEPT). ``seat``, ``lean`` and ``seat_depth`` say
    where the points and the normal were found on the two shapes, ``seat_reach`` up to which gap; what is round is
    seated beneath itself, however it has rolled (`roll_back`), since by points that it took along it would drive
    itself on. Those placed are ``kept``, and it is written where they are from their bodies. Each thread has a row
    of ``ends``, where those and its pairs end: behind them are those of the next.
    """
    begin_pair, end_pair = part_of(crew, len(pairs))
    placed = np.empty(PLACED * (old_count + WIDTH))  # of one pair, eight at a time: depth, normal, point, how it leans
    o = 0
    if 0 < begin_pair < end_pair:
        o = first_of_pair(0, old_count, pairs[begin_pair, 0], pairs[begin_pair, 1], a, b, handles, row_shift)
    begin_contact, count, moving = o, o, begin_pair  # they are no more than there were: no two threads write one place
    for p in range(begin_pair, end_pair):
        x, y = pairs[p, 0], pairs[p, 1]
        moved[moving, 0], moved[moving, 1], moved_reaches[moving] = x, y, reaches[p]
        moving += 1
        o = first_of_pair(o, old_count, x, y, a, b, handles, row_shift)
        if not is_pair(o, old_count, x, y, a, b, handles):
            continue
        if is_ball(x, shape) or is_ball(y, shape):
            moved_reaches[moving - 1] *= REACH_KEPT
            continue
        if not known and form[o] != form_of_pair(x, y, shape, size, geometry):
            continue
        slip = RECYCLED_SLIP * smaller_reach(x, y, bound_half, bound_radius)
        if reaches[p] > seat_reach[o] + slip:
            continue
        first, one, other, alike, stayed = o, a[o], b[o], True, True
        while o < old_count and a[o] == one and b[o] == other:
            alike &= o == first or is_alike(o, o - 1, lean_a)
            o += 1
        of_x, of_y = rotation_of(x, rotation), rotation_of(y, rotation)
        x_rolls, y_rolls = rolls(x, shape), rolls(y, shape)
        both = x_rolls and y_rolls
        if x_rolls:
            of_x = roll_back(of_x, x, first, o, 1.0, shape, size, of_y, lean_b, both, normal, seat_a, lean_a)
        if y_rolls:
            of_y = roll_back(of_y, y, first, o, -1.0, shape, size, of_x, lean_a, both, normal, seat_b, lean_b)
        with_x = 0.5 * x_rolls - 0.5 * y_rolls
        for begin in range(first, o, WIDTH):
            at = min(begin, len(seat_depth) - WIDTH)
            theirs = ALL << begin - at & ALL >> max(0, at + WIDTH - o)
            strays = place_contacts(
                at, x, y, first if alike else -1, slip, reaches[p], position, of_x, of_y, with_x,
                seat_a, seat_b, lean_a, lean_b, seat_depth, begin - first, placed,
            )  # fmt: skip
            stayed &= strays & theirs == 0
        if not stayed:
            continue
        moving -= 1
        for c in range(first, o):
            begin = (c - first) // WIDTH * WIDTH
            k = PLACED * begin + c - min(first + begin, len(seat_depth) - WIDTH)
            depth[c], kept[count] = placed[k], c
            for axis in range(3):
                normal[c, axis] = placed[k + WIDTH * (1 + axis)]
                point[c, axis] = placed[k + WIDTH * (4 + axis)]
            if not known:
                row_a[c], row_b[c] = x, y
            if x_rolls or y_rolls:
                pass  # whether it glides over a face stays as it was found (`find_faces`)
            elif c == first or not alike:
                flat_x, flat_y = is_flat_where_seated(x, c, lean_a, shape), is_flat_where_seated(y, c, lean_b, shape)
                flat_y &= placed[k + WIDTH * 7] <= LEANING * LEANING  # normals go with x, from which y may have turned
                share[c] = share_of_b(flat_x, flat_y)
            else:
                share[c] = share[first]
            count += 1
        find_offsets(first, o, x, y, normal, depth, point, body_row, position, center, offset_a, offset_b)
    _, part, parts = crew
    for turn_of in range(parts):
        if turn_of == part:
            to, to_pair = (ends[part - 1, 0], ends[part - 1, 1]) if part else (0, 0)
            for c in range(begin_contact, count if to < begin_contact else begin_contact):
                kept[to + c - begin_contact] = kept[c]
            for p in range(begin_pair, moving if to_pair < begin_pair else begin_pair):
                q = to_pair + p - begin_pair
                moved[q, 0], moved[q, 1], moved_reaches[q] = moved[p, 0], moved[p, 1], moved_reaches[p]
            ends[part, 0], ends[part, 1] = to + count - begin_contact, to_pair + moving - begin_pair
        wait_for_all(crew, 1 + turn_of)


@woven
def place_contacts(
    at, x, y, like, slip, reach, position, of_x, of_y, with_x, seat_a, seat_b, lean_a, lean_b, seat_depth, to, placed
):  # fmt: skip
    """Write where eight contacts of two colliders are now; return as bits which have slipped, sunk or turned too far.

    Their normals are all ``like`` that of one contact, where that is not below 0. Points are in the middle, and
    ``with_x`` (-0.5 to 0.5) says how much more they go with x than with y.
    """
    if like >= 0:
        nx, ny, nz = spread_three(turned_by(of_x, like, lean_a))
        mx, my, mz = spread_three(turned_by(of_y, like, lean_b))
    else:
        nx, ny, nz = eight_turned_by(of_x, at, lean_a)
        mx, my, mz = eight_turned_by(of_y, at, lean_b)
    leant = (nx - mx) * (nx - mx) + (ny - my) * (ny - my) + (nz - mz) * (nz - mz)
    ax, ay, az = eight_turned_by(of_x, at, seat_a)
    bx, by, bz = eight_turned_by(of_y, at, seat_b)
    ax, ay, az = ax + position[x, 0], ay + position[x, 1], az + position[x, 2]
    bx, by, bz = bx + position[y, 0], by + position[y, 1], bz + position[y, 2]
    dx, dy, dz = ax - bx, ay - by, az - bz
    deep = nx * dx + ny * dy + nz * dz
    aside = dx * dx + dy * dy + dz * dz - deep * deep
    sunk = deep - load_flat(seat_depth, at)
    far = larger(leant - RECYCLED_TURN * RECYCLED_TURN, aside - slip * slip)
    far = larger(far, larger(larger(sunk, -sunk) - slip, -deep - reach))
    px, py, pz = 0.5 * (ax + bx), 0.5 * (ay + by), 0.5 * (az + bz)
    if with_x != 0.0:
        px, py, pz = px + with_x * (dx - deep * nx), py + with_x * (dy - deep * ny), pz + with_x * (dz - deep * nz)
    to *= PLACED
    for k, lane in enumerate((deep, nx, ny, nz, px, py, pz, leant)):
        store_flat(placed, to + WIDTH * k, lane)
    return which(far)


@woven
def spread_three(v):
    """Return a vector in all lanes."""
    return spread(v[0]), spread(v[1]), spread(v[2])


@woven
def eight_turned_by(q, at, column):
    """Return the vectors of eight contacts turned by a quaternion."""
    x, y, z = load_three(address(column), at)
    return turn(q[0], q[1], q[2], q[3], x, y, z)


@woven
def first_of_pair(o, old_count, x, y, a, b, handles, row_shift):
    """Return the first contact from ``o`` on, all sorted by pair, that is of the rows (x, y) or of a later pair."""
    if is_pair(o, old_count, x, y, a, b, handles):  # most often
        return o
    while o < old_count:
        q, r = row_of(a[o], row_shift), row_of(b[o], row_shift)
        living = is_at(q, a[o], handles) and is_at(r, b[o], handles)
        if living and (q > x or (q == x and r >= y)):  # others have lost their order
            break
        o += 1
    return o


@woven
def is_pair(o, count, x, y, a, b, handles):
    """Tell whether the o-th of ``count`` contacts or pairs is of the rows x and y."""
    return o < count and is_at(x, a[o], handles) and is_at(y, b[o], handles)


@woven
def row_of(entity, row_shift):
    """Return the row that an entity has if it lives."""
    index = entity & INDEX_MASK
    return index + row_shift[index]


@woven
def is_at(row, entity, handles):
    """Tell whether an entity lives in a row."""
    return row < len(handles) and handles[row] == entity


@woven
def smaller_reach(a, b, bound_half, bound_radius):
    """Return the longest half extent of the smaller of two colliders (m)."""
    of_a = bound_radius[a] + max(bound_half[a, 0], bound_half[a, 1], bound_half[a, 2])
    of_b = bound_radius[b] + max(bound_half[b, 0], bound_half[b, 1], bound_half[b, 2])
    return min(of_a, of_b)


@woven
def rotation_of(i, rotation):
    """Return the quaternion of collider i."""
    return rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]


@woven
def turned_by(q, c, column):
    """Return a vector of contact c turned by a quaternion."""
    return turn(q[0], q[1], q[2], q[3], column[c, 0], column[c, 1], column[c, 2])


@woven
def turned(i, c, column, rotation):
    """Return a vector of contact c as collider i, in whose frame it is, is turned now."""
    return turned_by(rotation_of(i, rotation), c, column)


@woven
def seat_pair(
    first, end, a, b, reach, normal, depth, point, shape, size, geometry, position, rotation,
    seat_a, seat_b, lean_a, lean_b, seat_depth, seat_reach, form,
):  # fmt: skip
    """Write where the points and the normals of a pair, contacts ``first`` to ``end``, are on the two shapes.

    They are all up to its ``reach`` (m). Those of balls are never recycled, and nowhere.
    """
    if is_ball(a, shape) or is_ball(b, shape):
        for c in range(first, end):
            if form[c] == 0.0:  # as it most often was before
                continue
            seat_depth[c], seat_reach[c], form[c] = 0.0, 0.0, 0.0
            for k in range(3):
                seat_a[c, k], seat_b[c, k], lean_a[c, k], lean_b[c, k] = 0.0, 0.0, 0.0, 0.0
        return
    number = form_of_pair(a, b, shape, size, geometry)
    for c in range(first, end):
        half = 0.5 * depth[c]
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        for i, sense, seat, lean in ((a, half, seat_a, lean_a), (b, -half, seat_b, lean_b)):
            qx, qy, qz, qw = -rotation[i, 0], -rotation[i, 1], -rotation[i, 2], rotation[i, 3]
            x = point[c, 0] + sense * nx - position[i, 0]
            y = point[c, 1] + sense * ny - position[i, 1]
            z = point[c, 2] + sense * nz - position[i, 2]
            seat[c, 0], seat[c, 1], seat[c, 2] = turn(qx, qy, qz, qw, x, y, z)
            lean[c, 0], lean[c, 1], lean[c, 2] = turn(qx, qy, qz, qw, nx, ny, nz)
        seat_depth[c], seat_reach[c], form[c] = depth[c], reach, number
