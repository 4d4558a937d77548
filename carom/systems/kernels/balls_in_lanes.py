"""Contacts of balls with balls, a group at a time."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import groups as of
from carom.systems.kernels.balls import BALL
from carom.systems.kernels.groups import ABSENT, MANIFOLD_ROWS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_columns import pick, pick_one
from carom.systems.kernels.lane_vectors import TINY, dot, keep
from carom.systems.kernels.lanes import address, choose, gather_four, larger, load, root, some, spread, store
from carom.systems.kernels.packing import CENTER


@woven
def are_all_balls(kinds, there):
    """Tell whether all manifolds of a group, of such kinds, are of two balls."""
    return not some(choose(there, larger(kinds - BALL, BALL - kinds), spread(0.0)))


@woven
def place_balls(r, at, there, sign, radius, extent, even, lanes):
    """Write where the two balls of manifolds, at places in the table, meet: on the line between their centres.

    Groups that are ``even`` only need to know how far from these.
    """
    zero = spread(0.0)
    ball, other = pick_one(radius, at, there), choose(there, pick(address(extent), 3, 0, at), zero)
    is_a = pick_one(sign, at, there)
    of_a, of_b = choose(is_a, ball, other), choose(is_a, other, ball)
    if even:
        store(lanes, r + of.LEVER_A, of_a)
        store(lanes, r + of.LEVER_B, -of_b)
        return
    keep(lanes, r + of.MIDDLE_A, zero, zero, of_a)
    keep(lanes, r + of.MIDDLE_B, zero, zero, -of_b)
    store(lanes, r + MANIFOLD_ROWS + of.AT, zero)
    store(lanes, r + MANIFOLD_ROWS + of.AT + 1, zero)


@woven
def are_balls(r, lanes):
    """Tell whether all manifolds of a group are of two balls."""
    return lanes[r + of.BALL, 0] > 1.0


@woven
def measure_balls_in_lanes(g, r, even, index_a, index_b, lanes, bodies):
    """Measure the contacts of a group where the balls are; as `measure_ball` does, one by one."""
    of_a, of_b = (of.LEVER_A, of.LEVER_B) if even else (of.MIDDLE_A + 2, of.MIDDLE_B + 2)
    a, b = gather_four(bodies[CENTER], index_a, g, 0), gather_four(bodies[CENTER], index_b, g, 0)
    reach = load(lanes, r + of_a) - load(lanes, r + of_b)
    there, zero = load(lanes, r + of.SHARE), spread(0.0)
    way = (b[0] - a[0], b[1] - a[1], b[2] - a[2])
    distance = root(dot(way, way))
    inverse = choose(there, 1.0 / larger(distance, spread(TINY)), zero)
    x, z = way[0] * inverse, way[2] * inverse
    y = choose(distance, way[1] * inverse, choose(there, spread(-1.0), zero))  # concentric: any direction parts them
    keep(lanes, r + of.NORMAL, x, y, z)
    store(lanes, r + MANIFOLD_ROWS + of.DEPTH, choose(there, reach - distance, spread(ABSENT)))
