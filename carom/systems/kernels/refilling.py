"""Refilling: groups that stay take what their contacts have come to be, and keep what they hold of impulses."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import groups as of
from carom.systems.kernels.balls_in_lanes import are_balls
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.filling import find_tangents, goes_with_b, keep_where, place_points, places_of, write_cores
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_columns import LANES, lane_of, numbers_at, pick_one, pick_three
from carom.systems.kernels.lane_vectors import dot, keep, minus, plus, three, times, where
from carom.systems.kernels.lanes import address, choose, load, spread, store


@shared("lanes")
def refill_groups(
    crew, groups, first, size, row, points, even, normal, depth, offset_a, offset_b, share_of_b, resting,
    row_a, row_b, body_a, body_b, rotation, shape, size_of_shape, bound_radius, lanes,
):  # fmt: skip
    """Write into the lanes of groups what `fill_groups` would, where they are as that has filled them.

    So are contacts that the table holds where it held them, of the same shapes and materials, whose impulses have been
    handed over; where balls are is measured later.
    """
    rows, zero, one = address(lanes), spread(0.0), spread(1.0)
    begin, end = part_of(crew, groups)
    for g in range(begin, end):
        r, at, sizes = row[g], places_of(g, 0, first, size), lane_of(numbers_at(size[g], LANES))
        keep(rows, r + of.RUBBED, zero, zero, zero)
        store(rows, r + of.RESTS, choose(sizes, lane_of(numbers_at(resting, at)), zero))
        for p in range(points[g]):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            store(rows, q + of.WARM, choose(sizes - float(p), load(rows, q + of.WARM), zero))
            store(rows, q + of.SUM, zero)
        share = load(rows, r + of.SHARE)
        pushed = times(share, three(rows, r + of.RUB))
        keep_where(rows, r + of.RUB, load(rows, r + of.FRICTION), sum_over_points(points[g], sizes, pushed))
        if even[g]:
            continue
        turned = times(load(rows, r + of.SPUN), three(rows, r + of.NORMAL))
        rolled = sum_over_points(points[g], sizes, times(share, plus(turned, three(rows, r + of.ROLLED))))
        n = pick_three(normal, at, sizes)
        keep(rows, r + of.NORMAL, n[0], n[1], n[2])
        along, as_ball = dot(n, rolled), choose(load(rows, r + of.BALL), one, zero)
        rolls = choose(as_ball, load(rows, r + of.ROLLING), one)
        store(rows, r + of.SPUN, choose(choose(as_ball, load(rows, r + of.SPINNING), one), along, zero))
        keep_where(rows, r + of.ROLLED, rolls, minus(rolled, times(along, n)))
        store(rows, r + of.PART, one)
        store(rows, r + of.BESIDE, zero)
        store(rows, r + of.SWUNG, zero)
        keep(rows, r + of.LAG, zero, zero, zero)
        if not are_balls(r, lanes):
            find_tangents(r, rows)
            write_cores(
                g, r, first, row_a, row_b, body_a, body_b, rotation, normal, share_of_b, shape, size_of_shape,
                bound_radius, lanes,
            )  # fmt: skip
            store(rows, r + of.GOES, goes_with_b(pick_one(share_of_b, at, sizes), load(rows, r + of.LAND)))
            place_points(g, r, points[g], first, size, offset_a, offset_b, depth, lanes)


@woven
def sum_over_points(points, sizes, x):
    """Return the sum of what all points of a manifold share alike: in the order and rounding of `fill_groups`."""
    zero = spread(0.0)
    total = (zero, zero, zero)
    for p in range(points):
        total = plus(total, where(sizes - float(p), x))
    return total
