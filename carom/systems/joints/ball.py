"""Ball: turns every way about a point."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from carom.ecs.components.joint import EULER, SWING_TWIST
from carom.systems.declared import bounds
from carom.systems.joints.axis_joint import AxisJoint
from carom.systems.joints.held import Held
from carom.systems.joints.ways import Limits, Ways
from carom.systems.parameters import parameter


@dataclass(frozen=True, kw_only=True)
class Ball(AxisJoint):
    """b turns every way about a point of a, as an arm in its shoulder."""

    key: ClassVar[str] = "ball"
    swing: float | None = parameter(
        unit="rad", doc="greatest angle between the axis of a and that of b", default=None, above=0.0, most=math.pi
    )
    twist: Limits | None = bounds(unit="rad", doc="least and greatest turn of b about the axis")
    friction: float = parameter(
        unit="N m", doc="greatest torque of friction about the axis and each of two across it", default=0.0, least=0.0
    )

    def needs_axis(self) -> bool:
        """Tell whether swing or twist are limited."""
        return self.swing is not None or self.twist is not None

    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Lock the point; a swing is never below 0, whatever the axis about which it is measured then."""
        ways.lock(0, 1, 2)
        ways.limit(3, self.twist)
        ways.limit(4, None if self.swing is None else (-math.inf, self.swing))
        ways.rub(self.friction, 3, 4, 5)

    def columns(self, a: Held, b: Held) -> dict[str, Any]:
        """Return the same as of an axis; what bounds its turns is measured as twist and swing."""
        bounded = self.needs_axis() or self.friction > 0.0
        return super().columns(a, b) | {"about": SWING_TWIST if bounded else EULER}
