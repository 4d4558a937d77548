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
def fill_radii(g, r, first, kind, sign, radius, extent, lanes):
    """Write the radii of both balls into the lanes of a group; -1 where not all of its manifolds are of two balls."""
    balls = True
    for lane in range(WIDTH):
        c = first[g, lane]
        balls &= c < 0 or kind[c] == BALL
    for lane in range(WIDTH):
        c = first[g, lane]
        of_a, of_b = 0.0, 0.0
        if c >= 0:
            of_a, of_b = (radius[c], extent[c, 0]) if sign[c] > 0.0 else (extent[c, 0], radius[c])
        lanes[r + of.RADIUS_A, lane], lanes[r + of.RADIUS_B, lane] = of_a if balls else -1.0, of_b


@woven
def are_balls(r, lanes):
    """Tell whether all manifolds of a group are of two balls, as `fill_radii` found."""
    return lanes[r + of.RADIUS_A, 0] >= 0.0


@woven
def measure_balls_in_lanes(g, r, index_a, index_b, lanes, bodies):
    """Measure the contacts of a group where the balls are; as `measure_ball` does, one by one."""
    a, b = gather(bodies, index_a, g, CENTER), gather(bodies, index_b, g, CENTER)
    of_a, of_b = load(lanes, r + of.RADIUS_A), load(lanes, r + of.RADIUS_B)
    there, zero = load(lanes, r + of.SHARE), spread(0.0)
    way = (b[0] - a[0], b[1] - a[1], b[2] - a[2])
    distance = root(dot(way, way))
    inverse = choose(there, 1.0 / larger(distance, spread(TINY)), zero)
    x, z = way[0] * inverse, way[2] * inverse
    y = choose(distance, way[1] * inverse, choose(there, spread(-1.0), zero))  # concentric: any direction parts them
    q = r + MANIFOLD_ROWS
    keep(lanes, r + of.NORMAL, x, y, z)
    keep(lanes, q + of.OFFSET_A, of_a * x, of_a * y, of_a * z)
    keep(lanes, q + of.OFFSET_B, -of_b * x, -of_b * y, -of_b * z)
    store(lanes, q + of.DEPTH, choose(there, of_a + of_b - distance, spread(ABSENT)))


@woven
def write_normals(g, r, first, lanes, normal):
    """Write the normals of a group into the contact table."""
    for lane in range(WIDTH):
        c = first[g, lane]
        if c >= 0:
            for k in range(3):
                normal[c, k] = lanes[r + of.NORMAL + k, lane]


@woven
def write_points(g, r, first, index_a, center, lanes, depth, point, offset_a, offset_b):
    """Write the points of a group into the contact table."""
    q = r + MANIFOLD_ROWS
    for lane in range(WIDTH):
        c = first[g, lane]
        if c < 0:
            continue
        i = index_a[g, lane]
        depth[c] = lanes[q + of.DEPTH, lane]
        for k in range(3):
            n, to_a = lanes[r + of.NORMAL + k, lane], lanes[q + of.OFFSET_A + k, lane]
            offset_a[c, k], offset_b[c, k] = to_a, lanes[q + of.OFFSET_B + k, lane]
            point[c, k] = center[i, k] + (to_a - 0.5 * depth[c] * n)
