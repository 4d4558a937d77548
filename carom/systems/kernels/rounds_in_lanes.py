"""Rounds in lanes: between two that are round the normal turns as they go, with the line from one core to the other.

A core is the middle of a ball, or the nearest place on the axis of a capsule or a cylinder, along which the other may
glide without turning it.
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import GOES_ROUND, ON_SIDE, ROUND_GAP
from carom.systems.kernels import groups as of
from carom.systems.kernels.groups import ABSENT, MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import cross, dot, minus, plus, spanned, three
from carom.systems.kernels.lanes import choose, larger, load, some, spread
from carom.systems.kernels.levers import frame_of, seen_from


@woven
def write_curve(r, lane, reach, one, other, lanes):
    """Write how the normal of a manifold turns as its cores, ``reach`` (m) apart, go against each other.

    It is a symmetric 2 x 2 (1/m) in its tangents: 0 along the axes of ``one`` and the ``other``, which are 0 of balls.
    """
    at, au = lanes_dot(r + of.TANGENT, lane, one, lanes), lanes_dot(r + of.TANGENT + 3, lane, one, lanes)
    bt, bu = lanes_dot(r + of.TANGENT, lane, other, lanes), lanes_dot(r + of.TANGENT + 3, lane, other, lanes)
    stiff, aside = 1.0 / reach, at * bu - au * bt
    if aside * aside > ON_SIDE * ON_SIDE:  # axes that cross: either core is found anew along both
        stiff = 0.0
    if at * at + au * au == 0.0:
        at, au = bt, bu
    lanes[r + of.CURVE, lane] = stiff * (1.0 - at * at)
    lanes[r + of.CURVE + 1, lane] = stiff * (0.0 - at * au)
    lanes[r + of.CURVE + 2, lane] = stiff * (1.0 - au * au)


@woven
def lanes_dot(row, lane, x, lanes):
    """Return the product of a vector in a lane and another."""
    return lanes[row, lane] * x[0] + lanes[row + 1, lane] * x[1] + lanes[row + 2, lane] * x[2]


@woven
def turn_between(r, a, b, lanes):
    """Return by how much the normals of a group turn, as bodies go such ways or at such velocities; of others 0."""
    zero, tt, uu = spread(0.0), load(lanes, r + of.CURVE), load(lanes, r + of.CURVE + 2)
    curved = tt + uu
    if not some(curved):
        return zero, zero, zero
    frame, tu = frame_of(r, lanes), load(lanes, r + of.CURVE + 1)
    s_a, q_a, z_a = three(lanes, r + of.MIDDLE_A)
    s_b, q_b, z_b = three(lanes, r + of.MIDDLE_B)
    by_a = cross(seen_from(frame, a[4:7]), (s_a, q_a, z_a - load(lanes, r + of.CORE_A)))
    by_b = cross(seen_from(frame, b[4:7]), (s_b, q_b, z_b + load(lanes, r + of.CORE_B)))
    along, across, _ = plus(seen_from(frame, minus(b, a)), minus(by_b, by_a))
    x, y, z = spanned(-(tu * along + uu * across), frame[0], tt * along + tu * across, frame[1])
    return choose(curved, x, zero), choose(curved, y, zero), choose(curved, z, zero)


@woven
def those_that_go_round(r, points, h, turn, lanes):
    """Return more than 0 of manifolds that are near and whose normals turn by more than `GOES_ROUND` in h seconds."""
    zero, deepest = spread(0.0), spread(ABSENT)
    fast = dot(turn, turn) * (h * h) - GOES_ROUND * GOES_ROUND
    for p in range(points if some(fast) else 0):
        deepest = larger(deepest, load(lanes, r + MANIFOLD_ROWS + POINT_ROWS * p + of.DEPTH))
    near = ROUND_GAP * (load(lanes, r + of.CORE_A) + load(lanes, r + of.CORE_B))
    return choose(load(lanes, r + of.BALL), zero, choose(deepest + near, fast, zero))
