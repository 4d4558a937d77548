"""Softness: how contacts yield, and which impulse that makes of how fast they part."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import PUSH_SPEED, ROOT_GAP
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lanes import choose, smaller, spread


@woven
def aimed_at(depth, before, mass, parts, per_second, rate, hardness):
    """Return the impulse after which points would part as wanted, were all else to stay, and by how much per m/s.

    Overlap leaves at ``rate`` (1/s) times itself. A soft contact is a spring and a damper, stepped implicitly, of which
    ``hardness`` (part of the mass, and of the impulse that stays) remains: Catto, Soft Constraints, GDC 2011, and
    Solver2D, 2024 (soft step). A gap may close until the end of the substep, of which there are so many ``per_second``;
    one that is rounding is none, or corners that land together would not be alike.
    """
    gap = -depth - ROOT_GAP
    wanted = choose(gap, depth * per_second, smaller(depth * rate, spread(PUSH_SPEED)))
    hard = choose(gap, spread(1.0), spread(hardness))
    return hard * (before - mass * (parts - wanted)), hard * mass
