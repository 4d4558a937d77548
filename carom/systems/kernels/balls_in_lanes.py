"""Contacts of balls with balls, a group at a time."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import groups as of
from carom.systems.kernels.balls import BALL
from carom.systems.kernels.groups import ABSENT, MANIFOLD_ROWS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import TINY, dot, keep
from carom.systems.kernels.lanes import WIDTH, choose, gather, larger, load, root, spread, store
from carom.systems.kernels.packing import CENTER


@woven
def find_balls(g, r, first, kind, sign, radius, extent, lanes):
    """Mark a group whose manifolds are all of two balls: they meet on the line between their centres."""
    for lane in range(WIDTH):
        c = first[g, lane]
        if c >= 0 and kind[c] != BALL:
            return
    for lane in range(WIDTH):
        c = first[g, lane]
        if c < 0:
            continue
        of_a, of_b = (radius[c], extent[c, 0]) if sign[c] > 0.0 else (extent[c, 0], radius[c])
        lanes[r + of.BALL, lane] = 2.0
        lanes[r + of.MIDDLE_A + 2, lane], lanes[r + of.MIDDLE_B + 2, lane] = of_a, -of_b
        for k in range(2):
            lanes[r + of.MIDDLE_A + k, lane] = lanes[r + of.MIDDLE_B + k, lane] = 0.0


@woven
def are_balls(r, lanes):
    """Tell whether all manifolds of a group are of two balls, as `find_balls` found."""
    return lanes[r + of.BALL, 0] > 1.0


@woven
def measure_balls_in_lanes(g, r, index_a, index_b, lanes, bodies):
    """Measure the contacts of a group where the balls are; as `measure_ball` does, one by one."""
    a, b = gather(bodies[CENTER], index_a, g), gather(bodies[CENTER], index_b, g)
    reach = load(lanes, r + of.MIDDLE_A + 2) - load(lanes, r + of.MIDDLE_B + 2)
    there, zero = load(lanes, r + of.SHARE), spread(0.0)
    way = (b[0] - a[0], b[1] - a[1], b[2] - a[2])
    distance = root(dot(way, way))
    inverse = choose(there, 1.0 / larger(distance, spread(TINY)), zero)
    x, z = way[0] * inverse, way[2] * inverse
    y = choose(distance, way[1] * inverse, choose(there, spread(-1.0), zero))  # concentric: any direction parts them
    keep(lanes, r + of.NORMAL, x, y, z)
    store(lanes, r + MANIFOLD_ROWS + of.DEPTH, choose(there, reach - distance, spread(ABSENT)))


@woven
def write_normals(g, r, first, lanes, normal):
    """Write the normals of a group into the contact table."""
    for lane in range(WIDTH):
        c = first[g, lane]
        if c >= 0:
            for k in range(3):
                normal[c, k] = lanes[r + of.NORMAL + k, lane]


@woven
def write_touches(g, r, first, index_a, center, lanes, depth, point, offset_a, offset_b):
    """Write where the balls of a group touch into the contact table."""
    for lane in range(WIDTH):
        c = first[g, lane]
        if c < 0:
            continue
        i, depth[c] = index_a[g, lane], lanes[r + MANIFOLD_ROWS + of.DEPTH, lane]
        for k in range(3):
            n = lanes[r + of.NORMAL + k, lane]
            offset_a[c, k] = lanes[r + of.MIDDLE_A + 2, lane] * n
            offset_b[c, k] = lanes[r + of.MIDDLE_B + 2, lane] * n
            point[c, k] = center[i, k] + (offset_a[c, k] - 0.5 * depth[c] * n)
