"""Whirling: bodies that turn far in a substep, by joints far from their centres, which chains of such would tear apart.

An impulse goes on as it was in the world or a body's frame, while that turns by an angle; at the end of an arm the
error turns the body by as much more as the end yields more by turning than by moving.
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import JOINT_SPEED, STALE, WHIRLS
from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.joint_groups import KINDS, bound, slot, slots_of
from carom.systems.kernels.joint_motion import turning_of
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import TINY, dot, three
from carom.systems.kernels.lanes import choose, gather, larger, load, smaller, some, spread, store
from carom.systems.kernels.packing import INVERSE, INVERSE_MASS


@woven
def heed_whirling(g, r, kind, h, a, b, index_a, index_b, lanes, bodies):
    """Say how fast joints of a group may go back to their places, of bodies with the velocities a and b that whirl.

    Where these do by far, only part of the impulses of the substep before, which lasted h seconds, is left.
    """
    of_a, of_b = gather(bodies[INVERSE], index_a, g), gather(bodies[INVERSE], index_b, g)
    whirl = larger(whirl_of(three(lanes, r + of.ARM_A), of_a, a, h), whirl_of(three(lanes, r + of.ARM_B), of_b, b, h))
    one, per = spread(1.0), 1.0 / larger(whirl, spread(TINY))
    store(lanes, r + of.BACK, JOINT_SPEED * larger(WHIRLS * per, one))
    if not some(whirl - STALE):  # nearly always
        return
    part, slots = smaller(STALE * per, one), slots_of(kind)
    for s in range(slots):
        q = slot(r, s) + of.HOLD
        store(lanes, q, part * load(lanes, q))
        if kind >= KINDS:
            p = bound(r, slots, s)
            for impulse in (p + of.DRIVE, p + of.RUB):
                store(lanes, impulse, part * load(lanes, impulse))


@woven
def whirl_of(arm, inverse, v, h):
    """Return the square of how far a body of velocity v turns in h seconds (rad) by how much its end yields by that.

    That is the mean across its arm, along which nothing turns, as part of what it yields by moving.
    """
    w, mass = v[4:7], v[INVERSE_MASS]
    yields = turning_of(arm, inverse)
    by_turning = 0.5 * (yields[0] + yields[2] + yields[5])
    return choose(mass, h * h * dot(w, w) * by_turning / larger(mass, spread(TINY)), spread(0.0))


@woven
def going_back(r, speed, lanes):
    """Return how fast what a joint is off by goes, at the speed that it would, or as fast as it may."""
    most = load(lanes, r + of.BACK)
    return larger(smaller(speed, most), -most)
