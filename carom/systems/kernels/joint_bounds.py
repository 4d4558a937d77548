"""What bounds the free ways of a joint: friction, springs and motors, limits, one way after the other."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import BOUNCE_SPEED
from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.joint_groups import slot
from carom.systems.kernels.joint_motion import given, speed_of
from carom.systems.kernels.joint_whirling import going_back
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import TINY
from carom.systems.kernels.lanes import choose, larger, load, smaller, spread, store


@woven
def per(give):
    """Return 1 / give, 0 where nothing gives way."""
    return choose(give - TINY, 1.0 / larger(give, spread(TINY)), spread(0.0))


@woven
def rub(s, g, r, p, h, a, b, index_a, index_b, lanes, bodies):
    """Let friction stop a way, as far as it can."""
    before, most = load(lanes, p + of.RUB), load(lanes, p + of.RUBS) * h
    after = before - speed_of(s, r, a, b, lanes) * per(load(lanes, p + of.GIVE))
    after = larger(-most, smaller(most, after))
    store(lanes, p + of.RUB, after)
    return given(g, r, p, after - before, a, b, index_a, index_b, lanes, bodies)


@woven
def drive(s, g, r, p, relaxing, h, a, b, index_a, index_b, lanes, bodies):
    """Let spring and damper, or the motor, act on a way, stepped implicitly: stable however stiff they are.

    Their impulse is -h (k (x + h v' - target) + c (v' - speed)) for the velocity v' after it, the most force at most
    (Catto, Soft Constraints, GDC 2011). Springs have acted before the way; ``relaxing`` is none of theirs.
    """
    before, stiff, damping = load(lanes, p + of.DRIVE), load(lanes, p + of.STIFFNESS), load(lanes, p + of.DAMPING)
    soft = larger(damping + stiff * h, spread(TINY))  # 0 in lanes without a joint
    off = load(lanes, slot(r, s) + of.PLACE) - load(lanes, p + of.TARGET)
    wanted = (damping * load(lanes, p + of.WANTED) - stiff * off) / soft
    give = load(lanes, p + of.GIVE)
    after = (give * before - (speed_of(s, r, a, b, lanes) - wanted)) * per(
        give + load(lanes, p + of.YIELDS) / (soft * h)
    )
    most = load(lanes, p + of.MOST) * h
    after = larger(-most, smaller(most, after))
    if relaxing:
        after = choose(stiff, before, after)
    store(lanes, p + of.DRIVE, after)
    return given(g, r, p, after - before, a, b, index_a, index_b, lanes, bodies)


@woven
def limit(s, g, r, p, relaxing, rate, h, a, b, index_a, index_b, lanes, bodies):
    """Let no way go past the limit that is nearer, within the substep; bounce what has reached it."""
    q, zero = slot(r, s), spread(0.0)
    place, before = load(lanes, q + of.PLACE), load(lanes, q + of.HOLD)
    above, below = place - load(lanes, p + of.LOWER), load(lanes, p + of.UPPER) - place
    sign = choose(above - below, spread(-1.0), spread(1.0))
    gap = smaller(above, below)
    opening, held = sign * speed_of(s, r, a, b, lanes), sign * before
    wanted = choose(gap, -gap / h, going_back(r, -gap * rate, lanes))
    if relaxing:
        came = -(sign * load(lanes, q + of.SPEED))
        bounces = choose(held, choose(came - BOUNCE_SPEED, came * load(lanes, p + of.BOUNCE), zero), zero)
        wanted = choose(bounces, bounces, wanted)
    after = larger(zero, held + (wanted - opening) * per(load(lanes, p + of.GIVE)))
    j = sign * after - before
    store(lanes, q + of.HOLD, before + j)
    return given(g, r, p, j, a, b, index_a, index_b, lanes, bodies)
