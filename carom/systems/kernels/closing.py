"""Closing: which manifolds may strike within the substep, so that the flight need not ask those that cannot."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import ROOT_GAP
from carom.systems.kernels import groups as of
from carom.systems.kernels.balls_in_lanes import are_balls
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.lane_vectors import dot, three
from carom.systems.kernels.lanes import WIDTH, address, choose, gather, larger, load, planes, some, spread, store
from carom.systems.kernels.levers import parting_at, parting_of
from carom.systems.kernels.packing import MASS_AND_FELT, VELOCITY


@shared("lanes", "closing")
def find_closing(crew, groups, h, index_a, index_b, first, points, row, lanes, bodies, closing):
    """Tell for the first contact of each manifold that does not rest whether a point may close within ``h`` seconds.

    What `foresee_blow` finds is among them: forces count in full where they press. Groups of balls alone are left out.
    """
    rows, packed, of_a, of_b = address(lanes), planes(bodies), address(index_a), address(index_b)
    one, none = spread(1.0), spread(0.0)
    begin, end = part_of(crew, groups)
    for g in range(begin, end):
        r = row[g]
        free = choose(load(rows, r + of.SHARE), one - load(rows, r + of.RESTS), none)
        if are_balls(r, lanes) or not some(free):
            continue
        a, b = gather(packed[VELOCITY], of_a, g), gather(packed[VELOCITY], of_b, g)
        felt_a, felt_b = gather(packed[MASS_AND_FELT], of_a, g)[3:6], gather(packed[MASS_AND_FELT], of_b, g)[3:6]
        n, parting, closes = three(rows, r + of.NORMAL), parting_of(r, rows, a, b), none
        pressed = (larger(none, dot(n, felt_a)) + larger(none, -dot(n, felt_b))) * (0.5 * h * h)
        for p in range(points[g]):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            gap = parting_at(q, rows, parting) * h - load(rows, q + of.DEPTH)
            closes = choose(pressed - gap + ROOT_GAP, one, closes)
        store(rows, r + of.CLOSES, closes)
        for lane in range(WIDTH):
            if first[g, lane] >= 0:
                closing[first[g, lane]] = lanes[r + of.CLOSES, lane] > 0.0
