"""Fast pairs: who comes so far within a step for its size that it is looked after on its way."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import FAST, LEAST_FAST, TRUST
from carom.systems.kernels.contacts import is_centred, is_free_ball
from carom.systems.kernels.cores import AROUND, BEGIN, END, FIRST, HULL, KIND, SECOND, write_core
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.narrow import BOX_SHAPE, PLANE_SHAPE, POINT_SHAPE, SPHERE_SHAPE
from carom.systems.kernels.ray_colliders import FIELD_SHAPE, MESH_SHAPE
from carom.systems.kernels.spatial import cross, product, turn
from carom.systems.kernels.swinging import (
    LEVER,
    REACH,
    SMALLER,
    SPIN,
    SWING,
    TRUSTED,
    lever_of,
    reach_of,
    spin_of,
)

NEVER = 1e300
TRIANGLE_CORNERS = 3


@woven
def between(i, o, linear, other_linear):
    """Return how fast (m/s) the centres of bodies i and o move against each other; none is at rest."""
    squared = 0.0
    for k in range(3):
        speed = (linear[i, k] if i >= 0 else 0.0) - (other_linear[o, k] if o >= 0 else 0.0)
        squared += speed * speed
    return sqrt(squared)


@woven
def motion_of(i, o, center, linear, angular, other_linear, other_angular):
    """Return how fast the centre of body i moves (m/s) and how it turns (rad/s), as seen from o or the world."""
    x, y, z = linear[i, 0], linear[i, 1], linear[i, 2]
    wx, wy, wz = angular[i, 0], angular[i, 1], angular[i, 2]
    if o >= 0:
        ux, uy, uz = other_angular[o, 0], other_angular[o, 1], other_angular[o, 2]
        cx, cy, cz = cross(
            ux, uy, uz, center[i, 0] - center[o, 0], center[i, 1] - center[o, 1], center[i, 2] - center[o, 2]
        )
        x, y, z = x - other_linear[o, 0] - cx, y - other_linear[o, 1] - cy, z - other_linear[o, 2] - cz
        wx, wy, wz = wx - ux, wy - uy, wz - uz
    return sqrt(x * x + y * y + z * z), wx, wy, wz


@woven
def is_exact(i, o, shape, body_row, position, center, inverse_mass):
    """Tell whether collider i is a ball whose impacts with o are exact, so that it needs nobody to look ahead."""
    if not is_free_ball(i, shape, body_row, position, center, inverse_mass):
        return False
    if shape[o] not in (SPHERE_SHAPE, POINT_SHAPE, BOX_SHAPE, PLANE_SHAPE):
        return False
    return body_row[o] < 0 or is_centred(o, body_row[o], position, center)


@woven
def extent_of(c, bound_half, bound_radius):
    """Return the smallest half extent (m) that collider c is taken to have."""
    return max(LEAST_FAST, min(bound_half[c, 0], bound_half[c, 1], bound_half[c, 2]) + bound_radius[c])


@kernel("quick")
def find_quick(
    span, rows, local_position, bound_center, bound_half, bound_radius, position, body_row, center, inverse_mass,
    linear, angular, quick,
):  # fmt: skip
    """Mark the bodies of which each pair that is fast within ``span`` seconds has one; tell whether there are any.

    There are none where the fastest and the smallest of all, were they one, would not be: it would reach as far from
    its centre, too, as the farthest part of any and the largest are together. Else those are quick who would be half of
    such a pair.
    """
    smallest, speed, spin, away, off, half, around = NEVER, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for c in rows:
        i = body_row[c]
        if i < 0:
            continue
        if inverse_mass[i] > 0.0:
            smallest = min(smallest, extent_of(c, bound_half, bound_radius))
        away = max(away, squared_between(c, position, i, center))
        off = max(off, squared_between(c, bound_center, c, local_position))
        half, around = max(half, squared(c, bound_half)), max(around, bound_radius[c])
        speed, spin = max(speed, squared(i, linear)), max(spin, squared(i, angular))
    spin, lever = sqrt(spin), sqrt(away) + sqrt(off) + sqrt(half) + around
    way = (2.0 * sqrt(speed) + 4.0 * spin * lever) * span  # either turns, and moves what is out there with it
    if way * (1.0 + spin * span) <= FAST * smallest:
        return False
    for c in rows:
        i = body_row[c]
        if i >= 0:
            own = sqrt(squared(i, linear)) + sqrt(squared(i, angular)) * (3.0 * lever + way)
            quick[i] = span * own > 0.5 * FAST * smallest
    return True


@kernel("found")
def take_quick(pairs, body_row, quick, found):
    """Write the pairs of collider rows of which a body is ``quick``; return how many."""
    count = 0
    for p in range(len(pairs)):
        if is_one_quick(body_row[pairs[p, 0]], body_row[pairs[p, 1]], quick):
            found[count, 0], found[count, 1] = pairs[p, 0], pairs[p, 1]
            count += 1
    return count


@woven
def is_one_quick(i, o, quick):
    """Tell whether body i or o is ``quick``; none is not."""
    return (i >= 0 and quick[i]) or (o >= 0 and quick[o])


@woven
def squared(i, vectors):
    """Return the square of the length of vector i."""
    return vectors[i, 0] * vectors[i, 0] + vectors[i, 1] * vectors[i, 1] + vectors[i, 2] * vectors[i, 2]


@woven
def squared_between(i, one, o, other):
    """Return the square of how far place i of one column is from place o of another."""
    x, y, z = one[i, 0] - other[o, 0], one[i, 1] - other[o, 1], one[i, 2] - other[o, 2]
    return x * x + y * y + z * z


@kernel("fast", "numbers")
def find_fast(
    pairs, free, span, shape, size, local_position, bound_center, bound_half, bound_radius, position, rotation,
    body_row, center, inverse_mass, continuous, linear, angular, fast, numbers,
):  # fmt: skip
    """Write which pairs are to be looked after within ``span`` seconds, and their numbers; return how many.

    Those of a body that comes farther than FAST of its smallest half extent and what stands or is kinematic; where both
    can be pushed, only if one is ``continuous``; those of the others if they are to be ``free``.
    """
    count = 0
    for p in range(len(pairs)):
        a, b = pairs[p, 0], pairs[p, 1]
        i, o = body_row[a], body_row[b]
        free_a, free_b = i >= 0 and inverse_mass[i] > 0.0, o >= 0 and inverse_mass[o] > 0.0
        if free != (free_a and free_b and not (continuous[i] or continuous[o])):
            continue
        smallest, smaller = NEVER, 0
        for side in range(2):
            c = a if side == 0 else b
            extent = extent_of(c, bound_half, bound_radius)
            if (free_a if side == 0 else free_b) and extent < smallest:
                smallest, smaller = extent, side
        small, other = (i, o) if smaller == 0 else (o, i)
        way, wx, wy, wz = motion_of(small, other, center, linear, angular, linear, angular)
        c = a if smaller == 0 else b
        reach = reach_of(c, body_row[c], local_position, bound_center, bound_half, position, center)
        lever = lever_of(c, body_row[c], reach, wx, wy, wz, shape, size, position, rotation, center)
        swing = sqrt(wx * wx + wy * wy + wz * wz) * lever
        if span * (way + swing) <= FAST * smallest:
            continue
        if is_exact(a, b, shape, body_row, position, center, inverse_mass):
            continue
        if is_exact(b, a, shape, body_row, position, center, inverse_mass):
            continue
        fast[count, 0], fast[count, 1] = a, b
        for side, c, body in ((0, a, i), (1, b, o)):
            reach = reach_of(c, body, local_position, bound_center, bound_half, position, center)
            numbers[count, REACH + side] = numbers[count, LEVER + side] = reach
            if body >= 0:
                wx, wy, wz = angular[body, 0], angular[body, 1], angular[body, 2]
                numbers[count, LEVER + side] = lever_of(
                    c, body, reach, wx, wy, wz, shape, size, position, rotation, center
                )  # fmt: skip
        numbers[count, SMALLER], numbers[count, TRUSTED], numbers[count, SWING] = smaller, TRUST * smallest, swing
        count += 1
    return count


@kernel("pairs", "bodies", "numbers", "cores", "roots", "position", "rotation")
def place_fast(
    pairs, shape, size, geometry, body_row, pose_position, pose_rotation, center, body_rotation, angular, hulls,
    root, bodies, numbers, cores, roots, position, rotation,
):  # fmt: skip
    """Put the mesh of a pair first, a half space second, and write what both shapes are around, and where they are.

    They are in the frames of their ``bodies``, or in the world; how those turn is written too. Of a mesh there is where
    its tree begins, and the room behind the vertices of all hulls for those of one triangle at a time.
    """
    for p in range(len(pairs)):
        if shape[pairs[p, 1]] in (MESH_SHAPE, FIELD_SHAPE) or shape[pairs[p, 0]] == PLANE_SHAPE:
            pairs[p, 0], pairs[p, 1] = pairs[p, 1], pairs[p, 0]
            for k in (REACH, LEVER):
                numbers[p, k], numbers[p, k + 1] = numbers[p, k + 1], numbers[p, k]
        a, core = pairs[p, 0], cores[p]
        roots[p] = root[geometry[a]] if shape[a] == MESH_SHAPE or shape[a] == FIELD_SHAPE else -1
        write_core(shape, size, geometry, pairs[p, 1], hulls, core, SECOND)
        if roots[p] < 0:
            write_core(shape, size, geometry, a, hulls, core, FIRST)
        else:
            free = len(hulls.vertices)
            core[KIND], core[BEGIN], core[END], core[AROUND] = HULL, free, free + TRIANGLE_CORNERS, 0.0
        for side in range(2):
            c = pairs[p, side]
            i = bodies[p, side] = body_row[c]
            x, y, z = pose_position[c, 0], pose_position[c, 1], pose_position[c, 2]
            q = (pose_rotation[c, 0], pose_rotation[c, 1], pose_rotation[c, 2], pose_rotation[c, 3])
            wx, wy, wz = 0.0, 0.0, 0.0
            if i >= 0:
                wx, wy, wz = spin_of(i, body_rotation, angular)
                bx, by, bz, bw = -body_rotation[i, 0], -body_rotation[i, 1], -body_rotation[i, 2], body_rotation[i, 3]
                x, y, z = turn(bx, by, bz, bw, x - center[i, 0], y - center[i, 1], z - center[i, 2])
                q = product(bx, by, bz, bw, q[0], q[1], q[2], q[3])
            position[p, side, 0], position[p, side, 1], position[p, side, 2] = x, y, z
            for k, w in enumerate((wx, wy, wz)):
                numbers[p, SPIN + 3 * side + k] = w
            for k in range(4):
                rotation[p, side, k] = q[k]


@woven
def first_of_pairs(p, pairs, a, b):
    """Return the first of the pairs from p on that is of the rows a and b, the lower one first, or of a later pair."""
    while p < len(pairs):
        low, high = min(pairs[p, 0], pairs[p, 1]), max(pairs[p, 0], pairs[p, 1])
        if low > a or (low == a and high >= b):
            break
        p += 1
    return p


@woven
def is_of_pair(p, pairs, a, b):
    """Tell whether the p-th of the pairs is of the rows a and b."""
    return p < len(pairs) and min(pairs[p, 0], pairs[p, 1]) == a and max(pairs[p, 0], pairs[p, 1]) == b


@kernel("far")
def find_far(pairs, numbers, row_a, row_b, depth, far):
    """Say which contacts are of these pairs, which are looked after, and too ``far`` to be trusted; count them.

    Contacts are in order of pair, as pairs are.
    """
    p, count = 0, 0
    for c in range(len(row_a)):
        p = first_of_pairs(p, pairs, row_a[c], row_b[c])
        far[c] = is_of_pair(p, pairs, row_a[c], row_b[c]) and -depth[c] > numbers[p, TRUSTED]
        count += far[c]
    return count


@kernel("resting")
def let_go(pairs, count, row_a, row_b, resting):
    """Say that no contact of these pairs rests, nor of any other of which one does not: it is new, and to strike."""
    p, begin = 0, 0
    while begin < count:
        end, all_rest = begin, True
        while end < count and row_a[end] == row_a[begin] and row_b[end] == row_b[begin]:
            all_rest &= resting[end]
            end += 1
        p = first_of_pairs(p, pairs, row_a[begin], row_b[begin])
        rests = all_rest and not is_of_pair(p, pairs, row_a[begin], row_b[begin])
        for c in range(begin, end):
            resting[c] = rests
        begin = end
