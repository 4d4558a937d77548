"""Narrow phase: pairs sorted by what measures them."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.balls import BALL, BOX, HALF_SPACE
from carom.systems.kernels.crew import part_of, shared, wait_for_all
from carom.systems.kernels.kernel import inlined, kernel, woven
from carom.systems.kernels.spatial import turn
from carom.systems.shapes.box import Box
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.point import Point
from carom.systems.shapes.sphere import Sphere

AS_IT_IS, SWAPPED, FCLS = range(3)  # how a pair is measured: by its function either way round, or by FCL
SPHERE_SHAPE, POINT_SHAPE, BOX_SHAPE, PLANE_SHAPE = Sphere.number, Point.number, Box.number, Plane.number


@kernel("reaches")
def reach_of_pairs(pairs, body_row, reach, asleep, passes, reaches):
    """Write how near (m) each pair must come to be a contact."""
    for p in range(len(pairs)):
        reaches[p] = reach_of_pair(pairs[p, 0], pairs[p, 1], body_row, reach, asleep, passes)


@woven
def reach_of_pair(a, b, body_row, reach, asleep, passes):
    """Return how near (m) two colliders must come to be a contact: what their two bodies reach within the step.

    Who sleeps and what has no body ``passes`` by where all others go one way.
    """
    together = 0.0
    for c in (a, b):
        body = body_row[c]
        together += reach[body] if body >= 0 else 0.0
        together += passes if body < 0 or asleep[body] else 0.0
    return together


@shared("side", "order", "first", "second", "counts", "places")
def sort_by_function(crew, pairs, shape, function_of, swaps, side, order, first, second, counts, places):
    """Sort pairs by the number of the function that measures them, keeping their order otherwise.

    ``order[k]`` is a pair and ``first[k]``, ``second[k]`` its collider rows as the function takes them; ``side`` tells
    of each pair whether that is as it is, or `SWAPPED`; FCL takes all as they are. Each thread has a row of
    ``counts``, how many of its pairs each function measures, and one of ``places``, where it goes on writing those.
    Shapes beyond the table have function 0, which is FCL.
    """
    _, part, parts = crew
    begin, end = part_of(crew, len(pairs))
    last, run = 0, 0  # most often the next is measured as the last: how many go on is not in memory
    for p in range(begin, end):
        function = function_for(shape[pairs[p, 0]], shape[pairs[p, 1]], function_of)
        if function != last:
            counts[part, last] += run
            last, run = function, 0
        run += 1
    counts[part, last] += run
    wait_for_all(crew, 1)
    before = 0
    for function in range(counts.shape[1]):
        for one in range(parts):
            if one == part:
                places[part, function] = before
            before += counts[one, function]
    last, k = 0, places[part, 0]
    for p in range(begin, end):
        a, b = pairs[p, 0], pairs[p, 1]
        function = function_for(shape[a], shape[b], function_of)
        if function != last:
            places[part, last] = k
            last, k = function, places[part, function]
        order[k] = p
        swap = function > 0 and swaps[shape[a], shape[b]]
        side[p] = FCLS if function == 0 else SWAPPED if swap else AS_IT_IS
        first[k], second[k] = (b, a) if swap else (a, b)
        k += 1


@woven
def function_for(one, other, function_of):
    """Return the number of the function that measures two shapes; 0 beyond the table."""
    size = len(function_of)
    return function_of[one, other] if one < size and other < size else 0


@kernel("row_a", "row_b", "feature", "normal", "depth", "point", "by_fcl", "old")
def leave_out(
    some, old_a, old_b, old_feature, old_normal, old_depth, old_point, old_by_fcl, old_old,
    row_a, row_b, feature, normal, depth, point, by_fcl, old,
):  # fmt: skip
    """Write all contacts but ``some``."""
    c = 0
    for o in range(len(some)):
        if some[o]:
            continue
        row_a[c], row_b[c], feature[c] = old_a[o], old_b[o], old_feature[o]
        depth[c], by_fcl[c], old[c] = old_depth[o], old_by_fcl[o], old_old[o]
        for k in range(3):
            normal[c, k], point[c, k] = old_normal[o, k], old_point[o, k]
        c += 1


@woven
def is_ball(i, shape):
    """Tell whether a collider is a ball or a point."""
    return shape[i] == SPHERE_SHAPE or shape[i] == POINT_SHAPE


@inlined
def kind_and_extent(shape, sx, sy, sz, qx, qy, qz, qw):
    """Return how `gap_of_ball` reads a shape, and its extent; kind -1 where it has no closed form."""
    if shape in (SPHERE_SHAPE, POINT_SHAPE):
        return BALL, sx, 0.0, 0.0
    if shape == BOX_SHAPE:
        return BOX, 0.5 * sx, 0.5 * sy, 0.5 * sz
    if shape == PLANE_SHAPE:
        nx, ny, nz = turn(qx, qy, qz, qw, sx, sy, sz)
        return HALF_SPACE, nx, ny, nz
    return -1, 0.0, 0.0, 0.0
