"""Closing: which manifolds may strike within the substep, so that the flight need not ask those that cannot."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import ROOT_GAP
from carom.systems.kernels import groups as of
from carom.systems.kernels.balls import BALL, BOX
from carom.systems.kernels.balls_in_lanes import are_balls
from carom.systems.kernels.crew import part_of, wait_for_all
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.lane_vectors import dot, three
from carom.systems.kernels.lanes import address, choose, gather, larger, load, planes, some, spread, store
from carom.systems.kernels.levers import parting_at, parting_of
from carom.systems.kernels.packing import MASS_AND_FELT, VELOCITY, felt_of, write_velocities
from carom.systems.kernels.reach import are_apart, stay_apart, time_within_all

# Of manifolds: it cannot strike as its bodies move now (nor does what rests and bounces), or may; it rests, and only a
# heavy blow makes an impact of it: one of a ball on an exact arc, and any other.
CANNOT, MAY, HELD_BALL, HELD = range(4)


@inlined
def find_closing(
    crew, count, groups, solids, h, rows, watched, stream, center, detected_center, reach, linear, angular,
    acceleration, index_a, index_b, points, row, group_of, lane_of, start, kind, ball, other, other_position,
    other_rotation, radius, extent, restitution, resting, lanes, bodies, closing, soon,
):  # fmt: skip
    """Tell of each manifold whether it may strike within ``h`` seconds, and how soon a body leaves its reach.

    Each thread has a row in ``soon``: when one of those leaves who are ``watched``, and how many may strike, among whom
    is what `foresee` and `foresee_blow` find. ``solids`` says that what is not of balls on exact arcs is to be asked,
    for which the velocities of all bodies (rows) are packed; else those may. ``start`` are the first contacts of
    manifolds.
    """
    begin, end = part_of(crew, len(watched))
    soon[crew[1], 0] = time_within_all(
        watched[begin:end], h, stream, center, detected_center, reach, linear, acceleration
    )  # fmt: skip
    if solids:
        begin, end = part_of(crew, len(rows))
        write_velocities(rows[begin:end], linear, angular, bodies[VELOCITY])
        wait_for_all(crew, 1)
        begin, end = part_of(crew, groups)
        for g in range(begin, end):
            if not are_balls(row[g], lanes):
                close_group(g, row[g], points[g], h, address(index_a), address(index_b), address(lanes), planes(bodies))
        wait_for_all(crew, 2)
    begin, end = part_of(crew, count)
    number = 0
    for m in range(begin, end):
        p = start[m]
        if resting[p] and kind[p] < 0 and restitution[p] == 0.0:
            closing[m] = HELD
        elif resting[p] and restitution[p] == 0.0:
            closing[m] = HELD_BALL
        elif (kind[p] == BOX and lanes[row[group_of[m]] + of.BESIDE, lane_of[m]] > 0.0) or (
            kind[p] == BALL
            and are_apart(p, ball[p], other[p], h, center, linear, acceleration, other_position, radius, extent)
        ):
            closing[m] = CANNOT
        else:
            may = True
            if kind[p] < 0:
                may = not solids or (not resting[p] and lanes[row[group_of[m]] + of.CLOSES, lane_of[m]] > 0.0)
            elif not resting[p]:
                may = not stay_apart(
                    p, ball[p], other[p], h, kind, center, linear, acceleration, other_position, other_rotation,
                    radius, extent,
                )  # fmt: skip
            closing[m] = MAY if may else CANNOT
            number += may
    soon[crew[1], 1] = number


@woven
def close_group(g, r, points, h, index_a, index_b, lanes, bodies):
    """Write which manifolds of a group may close, at one of their points; forces count in full where they press."""
    one, none = spread(1.0), spread(0.0)
    if not some(choose(load(lanes, r + of.SHARE), one - load(lanes, r + of.RESTS), none)):
        store(lanes, r + of.CLOSES, one)
        return
    a, b = gather(bodies[VELOCITY], index_a, g), gather(bodies[VELOCITY], index_b, g)
    felt_a, felt_b = felt_of(bodies[MASS_AND_FELT], index_a, g), felt_of(bodies[MASS_AND_FELT], index_b, g)
    n, parting, closes = three(lanes, r + of.NORMAL), parting_of(r, lanes, a, b), none
    pressed = (larger(none, dot(n, felt_a)) + larger(none, -dot(n, felt_b))) * (0.5 * h * h)
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        gap = parting_at(q, lanes, parting) * h - load(lanes, q + of.DEPTH)
        closes = choose(pressed - gap + ROOT_GAP, one, closes)
    store(lanes, r + of.CLOSES, closes)
