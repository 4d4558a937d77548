"""Spring: a soft joint between two points, stable at any stiffness."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

from carom.ecs.components.joint import Joint
from carom.systems.declared import Steps
from carom.systems.joints.held import Held
from carom.systems.joints.line_joint import LineJoint
from carom.systems.joints.ways import LinearMotor, Ways
from carom.systems.parameters import parameter


@dataclass(frozen=True, kw_only=True)
class Spring(LineJoint):
    """A spring with a damper along the line of the anchors; stiff ones lose energy, the force law of springs does not.

    Frequency and damping ratio are those of the two masses on it, as if they were points: with the reduced mass
    m = 1 / (1/m_a + 1/m_b), stiffness is m w^2 and damping 2 z m w (Catto, Soft Constraints, GDC 2011).
    """

    key: ClassVar[str] = "spring"
    stiffness: float | None = parameter(unit="N/m", doc="force per length", default=None, above=0.0)
    damping: float | None = parameter(unit="N s/m", doc="force per speed, 0 by default", default=None, least=0.0)
    frequency: float | None = parameter(unit="Hz", doc="swings per second, if undamped", default=None, above=0.0)
    damping_ratio: float | None = parameter(
        unit="1", doc="share of the damping at which it just does not swing, 0 by default", default=None, least=0.0
    )

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Yield that it is not known how stiff it is, or twice."""
        by_force = [name for name in ("stiffness", "damping") if getattr(self, name) is not None]
        by_rate = [name for name in ("frequency", "damping_ratio") if getattr(self, name) is not None]
        if by_force and by_rate:
            yield (by_rate[0],), f"is stated beside {by_force[0]}; state stiffness and damping, or the other two"
        elif (self.stiffness is None) is (self.frequency is None):
            yield (), "states no stiffness; accepted: stiffness and damping, or frequency and damping_ratio"

    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Pull to the length."""
        stiffness, damping = self.stiffness, self.damping
        if self.frequency is not None:
            mass, rate = 1.0 / (a.inverse_mass + b.inverse_mass), 2.0 * math.pi * self.frequency
            stiffness, damping = mass * rate * rate, 2.0 * (self.damping_ratio or 0.0) * mass * rate
        ways.drive(0, LinearMotor(target=self.rest(a, b), stiffness=stiffness, damping=damping))

    @classmethod
    def of(cls, joint: Joint) -> Self | None:
        """Return what states a joint that is driven along its line."""
        if not joint.driven[0]:
            return None
        stiffness, damping, length = (float(getattr(joint, name)[0]) for name in ("stiffness", "damping", "target"))
        return cls.of_line(joint, length=length, stiffness=stiffness, damping=damping or None)
