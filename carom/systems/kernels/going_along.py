"""Going along: contacts turn on within a step with whose face they are on, or as what is round goes round the other.

In a substep their frames are where that comes to be in its middle, so that how bodies part is right to second order:
what goes round together does not creep. How far the face has turned on beyond the frame is its lag.
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import LAGS, TOUCH
from carom.systems.kernels import groups as of
from carom.systems.kernels.groups import ABSENT, MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import TINY, cross, dot, keep, minus, plus, swung, three, times, where
from carom.systems.kernels.lanes import choose, gather_four, larger, load, some, spread
from carom.systems.kernels.levers import frame_of, seen_from
from carom.systems.kernels.packing import CENTER, INVERSE_MASS
from carom.systems.kernels.rounds_in_lanes import those_that_go_round, turn_between

TURNING_ROWS = (of.TANGENT, of.TANGENT + 3, of.NORMAL, of.RUB, of.ROLLED, of.SURFACE)  # vectors of a manifold


@woven
def turns_by_itself(body):
    """Return more than 0 of bodies, given by their velocities, that are kinematic and turn."""
    return choose(body[INVERSE_MASS], spread(0.0), dot(body[4:7], body[4:7]))


@woven
def turn_of_face(r, there, turn_a, turn_b, lanes):
    """Return how the face turns ``there``, which is that of who has no corners (`goes_with_b`).

    Of edges that cross it is half of each. What is round has none.
    """
    zero, goes = spread(0.0), load(lanes, r + of.GOES)
    core_a, core_b = load(lanes, r + of.CORE_A), load(lanes, r + of.CORE_B)
    by_a = choose(larger(core_a, -core_a), zero, choose(there, goes, zero))
    by_b = choose(larger(core_b, -core_b), zero, choose(there, 1.0 - goes, zero))
    return plus(times(by_a, turn_a), times(by_b, turn_b))


@woven
def set_out(g, r, points, h, bends, a, b, index_a, index_b, lanes, bodies):
    """Turn frames of a group on to the middle of a substep of h seconds; tell whether one is turned.

    Those on faces that turn (`those_that_turn`), and between two that are round (`those_that_go_round`).
    """
    zero, lag, fast = spread(0.0), three(lanes, r + of.LAG), those_that_turn(r, points, h, a, b, lanes)
    between = turn_between(r, a, b, lanes)
    rounds = those_that_go_round(r, points, h, between, lanes)
    if not some(larger(larger(fast, rounds), dot(lag, lag))):
        return False
    curved = load(lanes, r + of.CURVE) + load(lanes, r + of.CURVE + 2)
    fast = choose(choose(load(lanes, r + of.BALL), zero, curved), zero, fast)  # of those cores say where they meet
    half = turn_of_face(r, fast, times(0.5 * h, a[4:7]), times(0.5 * h, b[4:7]), lanes)
    half = plus(half, where(rounds, times(0.5 * h, between)))
    turn_frames(r, plus(half, lag), lanes)
    arc = choose(load(lanes, r + of.BALL), fast, zero) if bends else zero
    x, y, z = where(choose(arc, zero, larger(fast, rounds)), half)  # what bends arcs comes in the middle of the substep
    keep(lanes, r + of.LAG, -x, -y, -z)
    from_a, from_b = gather_four(bodies[CENTER], index_a, g, 0), gather_four(bodies[CENTER], index_b, g, 0)
    meet_in_one_place(r, fast, arc, half, minus(from_b, from_a), times(0.5 * h, minus(b, a)), lanes)
    return True


@woven
def those_that_turn(r, points, h, a, b, lanes):
    """Return more than 0 of manifolds whose frames are to turn.

    They are on what is kinematic and turns, or touch what else turns on by more than `LAGS` in h seconds; and both of
    their bodies move. Two balls are measured in each substep.
    """
    zero, on_a, on_b = spread(0.0), turns_by_itself(a), turns_by_itself(b)
    fast, deepest = larger(dot(a[4:7], a[4:7]), dot(b[4:7], b[4:7])) * (h * h) - LAGS * LAGS, spread(ABSENT)
    for p in range(points if some(fast) else 0):
        deepest = larger(deepest, load(lanes, r + MANIFOLD_ROWS + POINT_ROWS * p + of.DEPTH))
    fast = larger(larger(on_a, on_b), choose(deepest + TOUCH, fast, zero))
    both_go = choose(larger(a[INVERSE_MASS], on_a), larger(b[INVERSE_MASS], on_b), zero)
    ball = load(lanes, r + of.BALL)
    return choose(both_go, choose(ball, choose(1.5 - ball, larger(on_a, on_b), zero), fast), zero)


@woven
def meet_in_one_place(r, there, arc, half, apart, way, lanes):
    """Put the middles of manifolds ``there`` where corners are, from both bodies, when frames have turned by ``half``.

    Centres are ``apart`` at the start of the substep, and go such a ``way`` to its middle. Balls on an ``arc`` come to
    what the surface does at its end, as far as that turns about the normal.
    """
    frame, zero, squared = frame_of(r, lanes), spread(0.0), dot(half, half)
    in_the_end = seen_from(frame, plus(apart, times(2.0, way)))
    apart, way, turn = seen_before(r, half, apart, lanes), seen_before(r, half, way, lanes), seen_from(frame, half)
    along, across, _ = minus(way, cross(turn, apart))
    apart = times(1.0 - squared / 6.0, plus(apart, (along, across, zero)))  # chords are shorter than arcs
    part = choose(arc, turn[2] * turn[2] / larger(squared, spread(TINY)), zero)
    along, across, _ = times(part, minus(in_the_end, apart))
    apart = plus(apart, (along, across, zero))
    middle_a, middle_b, goes = three(lanes, r + of.MIDDLE_A), three(lanes, r + of.MIDDLE_B), load(lanes, r + of.GOES)
    off = where(there, minus(apart, minus(middle_a, middle_b)))
    x, y, z = plus(middle_a, times(choose(there, goes, zero), off))
    keep(lanes, r + of.MIDDLE_A, x, y, z)
    x, y, z = minus(middle_b, times(choose(there, 1.0 - goes, zero), off))
    keep(lanes, r + of.MIDDLE_B, x, y, z)


@woven
def turn_frames(r, turn, lanes):
    """Turn the frames of a group, and what holds in the world that goes with them."""
    half = times(0.5 + dot(turn, turn) / 24.0, turn)  # its tangent, for `swung` turns by twice the arc of that
    for row in TURNING_ROWS:
        x = three(lanes, r + row)
        x = plus(x, swung(half, x))
        keep(lanes, r + row, x[0], x[1], x[2])


@woven
def as_set_out(r, along, across, total, lanes):
    """Return the impulse of a group along its tangents as it is at the start of the substep, in whose middle those are.

    What takes velocities from the middle of the substep before to that of this one comes half way between: else it
    would drag along what slides. What friction has along the normal then is left to that.
    """
    t, u, n = seen_from(frame_of(r, lanes), three(lanes, r + of.LAG))
    return along + (u * total - n * across), across + (n * along - t * total)


@woven
def seen_before(r, turn, x, lanes):
    """Return a vector in frames of a group as they were before such a turn."""
    return seen_from(frame_of(r, lanes), plus(x, swung(times(0.5, turn), x)))
