"""Softness: how contacts yield, and which impulse that makes of how fast they part."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import BEARING, HARD_GAP, PUSH_SPEED, ROCKING, ROCKING_DEPTH
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lanes import choose, larger, smaller, spread


@woven
def of_any_load(yielding):
    """Return how contacts yield whatever they bear: a point alone cannot rock, and crashes are no loads."""
    return yielding[0], yielding[1], 0.0, 0.0


@woven
def leaving(points, yielding, parting):
    """Return which part of itself overlap leaves by (1/s): of what rocks on what cannot move, the less the faster.

    Lifted meanwhile as far as it sank in when it landed, it would rock on for good. Only what it sinks in by
    (ROCKING_DEPTH) leaves so slowly.
    """
    rate, hardness, _, _ = yielding
    if points == 1 or hardness < 1.0 or rate == 0.0:
        return spread(rate)
    return rate / (1.0 + (parting[1] * parting[1] + parting[2] * parting[2]) * (1.0 / (ROCKING * ROCKING)))


@woven
def aimed_at(depth, before, mass, parts, per_second, slow, yielding, bearing):
    """Return the impulse after which points would part as wanted, were all else to stay, and by how much per m/s.

    How contacts yield is (rate, hardness, load, part), as `yielding` returns it. Overlap leaves at the rate times
    itself, that up to ROCKING_DEPTH at the ``slow`` one. A soft contact is a spring and a damper, stepped implicitly,
    of which the hardness remains: Catto, Soft Constraints, GDC 2011, and Solver2D, 2024 (soft step). A gap may close
    until the end of the substep, of which there are so many ``per_second``; from HARD_GAP on it does not yield. What a
    point that is ``bearing`` bears beyond the load (0: none) times the mass goes by the part stated instead.
    """
    rate, hardness, load, part = yielding
    sunk = smaller(depth, spread(ROCKING_DEPTH))
    wanted = smaller(smaller(depth * per_second, sunk * slow + (depth - sunk) * rate), spread(PUSH_SPEED))
    hard = smaller(spread(1.0), hardness + larger(spread(0.0), -depth) * (1.0 / HARD_GAP))
    target = hard * (before - mass * (parts - wanted))
    if load > 0.0:
        excess = choose(bearing, larger(spread(0.0), before - load * mass), spread(0.0))
        target = target - (hard - (1.0 - part)) * excess
    return target, hard * mass


@woven
def borne(before, after, mass, per_second):
    """Return more than 0 where a point bears a load by which heavy bodies are told (BEARING), and did before."""
    return smaller(before, after) - mass * (BEARING / per_second)
