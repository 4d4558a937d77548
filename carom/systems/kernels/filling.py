"""Filling: what contacts hold goes into the lanes of their groups, and what the resting stage has found back."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import ON_SIDE
from carom.systems.kernels.balls_in_lanes import are_all_balls, place_balls
from carom.systems.kernels.blow_points import is_smooth
from carom.systems.kernels.cores import CYLINDER_SHAPE
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.frames import turned
from carom.systems.kernels.groups import (
    ABSENT,
    AT,
    BALL,
    BESIDE,
    CORE_A,
    CORE_B,
    CURVE,
    DEPTH,
    FRICTION,
    GOES,
    LAG,
    LAND,
    MANIFOLD_ROWS,
    MIDDLE_A,
    MIDDLE_B,
    NORMAL,
    PART,
    POINT_ROWS,
    RESTITUTION,
    RESTS,
    ROLLED,
    ROLLING,
    RUB,
    RUBBED,
    SHARE,
    SPINNING,
    SPUN,
    SUM,
    SURFACE,
    SWUNG,
    TANGENT,
    WARM,
)
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_columns import LANES, lane_of, numbers_at, pick, pick_one, pick_three
from carom.systems.kernels.lane_vectors import dot, keep, minus, plus, three, times, where
from carom.systems.kernels.lanes import WIDTH, address, choose, larger, load, spread, store
from carom.systems.kernels.narrow import BOX_SHAPE, PLANE_SHAPE
from carom.systems.kernels.polyhedra import CAPSULE_SHAPE
from carom.systems.kernels.resting_balls import are_even
from carom.systems.kernels.rounds_in_lanes import write_curve
from carom.systems.kernels.shares import shows_face
from carom.systems.kernels.spatial import plane_axes


@shared("lanes")
def fill_groups(
    crew, groups, first, size, row, points, even, normal, depth, offset_a, offset_b, share_of_b,
    kind, sign, radius, extent, friction, restitution, rolling, spinning, surface, resting,
    warm_normal, warm_friction, warm_rolling,
    row_a, row_b, body_a, body_b, rotation, shape, size_of_shape, bound_radius, lanes,
):  # fmt: skip
    """Write what contacts hold into the lanes of their groups.

    Of friction and rolling only their sums are of use: all points share them alike.
    """
    rows, zero, one = address(lanes), spread(0.0), spread(1.0)
    begin, end = part_of(crew, groups)
    for g in range(begin, end):
        r, at, sizes = row[g], places_of(g, 0, first, size), lane_of(numbers_at(size[g], LANES))
        keep(rows, r + RUBBED, zero, zero, zero)
        store(rows, r + RESTS, choose(sizes, lane_of(numbers_at(resting, at)), zero))
        store(rows, r + SHARE, choose(sizes, one / larger(sizes, one), zero))
        rough = pick_one(friction, at, sizes)
        store(rows, r + FRICTION, rough)
        store(rows, r + RESTITUTION, pick_one(restitution, at, sizes))
        n, pushed, rolled = pick_three(normal, at, sizes), (zero, zero, zero), (zero, zero, zero)
        for p in range(points[g]):
            q, at, there = r + MANIFOLD_ROWS + POINT_ROWS * p, places_of(g, p, first, size), sizes - float(p)
            store(rows, q + WARM, pick_one(warm_normal, at, there))
            store(rows, q + SUM, zero)
            pushed = plus(pushed, pick_three(warm_friction, at, there))
            if not even[g]:
                rolled = plus(rolled, pick_three(warm_rolling, at, there))
        keep(rows, r + NORMAL, n[0], n[1], n[2])
        keep_where(rows, r + RUB, rough, pushed)
        at = places_of(g, 0, first, size)
        if even[g]:
            place_balls(r, at, sizes, sign, radius, extent, True, rows)
            store(rows, r + BALL, spread(3.0))
            continue
        rolls, spins = pick_one(rolling, at, sizes), pick_one(spinning, at, sizes)
        store(rows, r + PART, one)
        store(rows, r + BESIDE, zero)
        store(rows, r + SWUNG, zero)
        keep(rows, r + LAG, zero, zero, zero)
        store(rows, r + ROLLING, rolls)
        store(rows, r + SPINNING, spins)
        x, y, z = pick_three(surface, at, sizes)
        keep(rows, r + SURFACE, x, y, z)
        kinds, along = lane_of(numbers_at(kind, at)), dot(n, rolled)
        as_ball = choose(sizes, choose(kinds + 0.5, one, zero), zero)
        store(rows, r + SPUN, choose(choose(as_ball, spins, one), along, zero))  # what is no ball twists by its points
        keep_where(rows, r + ROLLED, choose(as_ball, rolls, one), minus(rolled, times(along, n)))
        if are_all_balls(kinds, sizes):
            place_balls(r, at, sizes, sign, radius, extent, False, rows)
            store(rows, r + BALL, spread(2.0))
        else:
            store(rows, r + BALL, as_ball)
            find_tangents(r, rows)
            write_cores(
                g, r, first, row_a, row_b, body_a, body_b, rotation, normal, share_of_b, shape, size_of_shape,
                bound_radius, lanes,
            )  # fmt: skip
            store(rows, r + GOES, goes_with_b(pick_one(share_of_b, at, sizes), load(rows, r + LAND)))
            place_points(g, r, points[g], first, size, offset_a, offset_b, depth, lanes)


@woven
def keep_where(lanes, r, there, x):
    """Write the impulses that friction or rolling had, where there is such: nothing would take others out again."""
    x, y, z = where(there, x)
    keep(lanes, r, x, y, z)


@woven
def places_of(g, p, first, size):
    """Return where the p-th contacts of a group's manifolds are, the last ones of those that have fewer."""
    return (
        place_of(g, 0, p, first, size), place_of(g, 1, p, first, size), place_of(g, 2, p, first, size),
        place_of(g, 3, p, first, size), place_of(g, 4, p, first, size), place_of(g, 5, p, first, size),
        place_of(g, 6, p, first, size), place_of(g, 7, p, first, size),
    )  # fmt: skip


@woven
def place_of(g, lane, p, first, size):
    """Return where the p-th contact of a manifold is; anywhere, where there is no manifold."""
    return max(0, first[g, lane] + min(p, size[g, lane] - 1))


@woven
def find_tangents(r, lanes):
    """Find two tangents to the normals of a group.

    Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6 (1), 2017, as `plane_axes`.
    """
    x, y, z = three(lanes, r + NORMAL)
    sign = choose(-z, spread(-1.0), spread(1.0))
    p = -1.0 / (sign + z)
    q = x * y * p
    keep(lanes, r + TANGENT, 1.0 + sign * x * x * p, sign * q, -sign * x)
    keep(lanes, r + TANGENT + 3, q, sign + y * y * p, -y)


@woven
def place_points(g, r, points, first, size, offset_a, offset_b, depth, lanes):
    """Write where the points of a group are in its frame, and how deep."""
    rows, zero, sizes = address(lanes), spread(0.0), lane_of(numbers_at(size[g], LANES))
    t, u, n = three(rows, r + TANGENT), three(rows, r + TANGENT + 3), three(rows, r + NORMAL)
    of_a, of_b = (zero, zero, zero), (zero, zero, zero)
    for p in range(points):
        q, at, there = r + MANIFOLD_ROWS + POINT_ROWS * p, places_of(g, p, first, size), sizes - float(p)
        a, b = pick_three(offset_a, at, there), pick_three(offset_b, at, there)
        along, across = dot(t, b), dot(u, b)
        of_a, of_b = plus(of_a, (dot(t, a), dot(u, a), dot(n, a))), plus(of_b, (along, across, dot(n, b)))
        store(rows, q + AT, along)
        store(rows, q + AT + 1, across)
        store(rows, q + DEPTH, choose(there, pick(address(depth), 1, 0, at), spread(ABSENT)))
    share = load(rows, r + SHARE)
    keep(rows, r + MIDDLE_A, share * of_a[0], share * of_a[1], share * of_a[2])
    keep(rows, r + MIDDLE_B, share * of_b[0], share * of_b[1], share * of_b[2])
    for p in range(points):
        q, there = r + MANIFOLD_ROWS + POINT_ROWS * p, sizes - float(p)
        store(rows, q + AT, choose(there, load(rows, q + AT) - share * of_b[0], zero))
        store(rows, q + AT + 1, choose(there, load(rows, q + AT + 1) - share * of_b[1], zero))


@woven
def place_point(c, r, lane, normal, depth, offset_a, offset_b, lanes):
    """Write the frame of a manifold of one contact, where that is in it, and how deep."""
    x, y, z = normal[c, 0], normal[c, 1], normal[c, 2]
    tx, ty, tz, ux, uy, uz = plane_axes(x, y, z)
    for k, to, (ax, ay, az) in (
        (0, TANGENT, (tx, ty, tz)), (1, TANGENT + 3, (ux, uy, uz)), (2, NORMAL, (x, y, z)),
    ):  # fmt: skip
        lanes[r + to, lane], lanes[r + to + 1, lane], lanes[r + to + 2, lane] = ax, ay, az
        lanes[r + MIDDLE_A + k, lane] = ax * offset_a[c, 0] + ay * offset_a[c, 1] + az * offset_a[c, 2]
        lanes[r + MIDDLE_B + k, lane] = ax * offset_b[c, 0] + ay * offset_b[c, 1] + az * offset_b[c, 2]
    q = r + MANIFOLD_ROWS
    lanes[q + AT, lane] = lanes[q + AT + 1, lane] = 0.0
    lanes[r + LAG, lane] = lanes[r + LAG + 1, lane] = lanes[r + LAG + 2, lane] = 0.0
    lanes[q + DEPTH, lane] = depth[c]


@woven
def write_cores(
    g, r, first, row_a, row_b, body_a, body_b, rotation, normal, share_of_b, shape, size, bound_radius, lanes
):  # fmt: skip
    """Write how far points of manifolds are outside the cores of both bodies, -1 of what else is smooth; and `LAND`.

    The end of a cylinder over which points glide is as flat as the face of a box. And write how the normal turns with
    the cores of what is round on either side (`write_curve`).
    """
    for lane in range(WIDTH):
        c, land = first[g, lane], 0.0
        axes, cores = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), (0.0, 0.0)
        if c >= 0:
            core_a, axis_a = core_of(c, row_a[c], 1.0, rotation, normal, share_of_b, shape, size, bound_radius)
            core_b, axis_b = core_of(c, row_b[c], -1.0, rotation, normal, share_of_b, shape, size, bound_radius)
            axes, cores = (axis_a, axis_b), (core_a, core_b)
            for row, body, adds in ((row_a, body_a, 0.5), (row_b, body_b, -0.5)):
                if body[c] < 0 and shape[row[c]] != BOX_SHAPE and shape[row[c]] != PLANE_SHAPE:
                    land = adds
        lanes[r + CORE_A, lane], lanes[r + CORE_B, lane], lanes[r + LAND, lane] = cores[0], cores[1], land
        lanes[r + CURVE, lane] = lanes[r + CURVE + 1, lane] = lanes[r + CURVE + 2, lane] = 0.0
        if cores[0] > 0.0 and cores[1] > 0.0:
            write_curve(r, lane, cores[0] + cores[1], axes[0], axes[1], lanes)


@woven
def core_of(c, i, outward, rotation, normal, share_of_b, shape, size, bound_radius):
    """Return how far contact c is outside the core of collider i, and the axis that this has; of an end of it 0."""
    if not is_smooth(i, shape) and shape[i] != CAPSULE_SHAPE:
        return bound_radius[i], (0.0, 0.0, 0.0)
    if is_smooth(i, shape) and shows_face(c, outward, share_of_b):
        return 0.0, (0.0, 0.0, 0.0)
    x, y, z = turned(rotation, i, 0.0, 1.0, 0.0)
    along = x * normal[c, 0] + y * normal[c, 1] + z * normal[c, 2]
    lies = along * along <= ON_SIDE * ON_SIDE
    core = bound_radius[i] if shape[i] == CAPSULE_SHAPE else -1.0
    if shape[i] == CYLINDER_SHAPE and lies:
        core = size[i, 0]
    return core, ((x, y, z) if lies else (0.0, 0.0, 0.0))


@woven
def goes_with_b(share_of_b, land):
    """Return how much points go with b: with the corners of who touches ``land``, whose faces nobody looks for."""
    between = choose(share_of_b * (1.0 - share_of_b), land, spread(0.0))
    return share_of_b + between


@shared("lanes", "impulse", "friction_impulse", "warm_normal", "warm_friction", "warm_rolling")
def hand_over(
    crew, groups, first, size, row, lanes, impulse, friction_impulse, warm_normal, warm_friction, warm_rolling
):
    """Write the impulses that the resting stage has found back into the contact table."""
    begin, end = part_of(crew, groups)
    for g in range(begin, end):
        r, even = row[g], are_even(row[g], lanes)
        for lane in range(WIDTH):
            share, c = lanes[r + SHARE, lane], first[g, lane]
            x, y, z = share * lanes[r + RUB, lane], share * lanes[r + RUB + 1, lane], share * lanes[r + RUB + 2, lane]
            sx, sy, sz = lanes[r + RUBBED, lane], lanes[r + RUBBED + 1, lane], lanes[r + RUBBED + 2, lane]
            sx, sy, sz, rx, ry, rz = share * sx, share * sy, share * sz, 0.0, 0.0, 0.0
            if not even:
                spun = lanes[r + SPUN, lane]
                rx = share * (spun * lanes[r + NORMAL, lane] + lanes[r + ROLLED, lane])
                ry = share * (spun * lanes[r + NORMAL + 1, lane] + lanes[r + ROLLED + 1, lane])
                rz = share * (spun * lanes[r + NORMAL + 2, lane] + lanes[r + ROLLED + 2, lane])
            lanes[r + RUBBED, lane] = lanes[r + RUBBED + 1, lane] = lanes[r + RUBBED + 2, lane] = 0.0
            for p in range(size[g, lane]):
                q, o = r + MANIFOLD_ROWS + POINT_ROWS * p, c + p
                warm_normal[o] = lanes[q + WARM, lane]
                impulse[o] += lanes[q + SUM, lane]
                lanes[q + SUM, lane] = 0.0
                warm_friction[o, 0], warm_friction[o, 1], warm_friction[o, 2] = x, y, z
                friction_impulse[o, 0] += sx
                friction_impulse[o, 1] += sy
                friction_impulse[o, 2] += sz
                warm_rolling[o, 0], warm_rolling[o, 1], warm_rolling[o, 2] = rx, ry, rz
