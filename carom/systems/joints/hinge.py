"""Hinge: turns about one axis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from carom.systems.declared import bounds, part
from carom.systems.joints.axis_joint import AxisJoint
from carom.systems.joints.held import Held
from carom.systems.joints.ways import AngularMotor, Limits, Ways
from carom.systems.parameters import parameter


@dataclass(frozen=True, kw_only=True)
class Hinge(AxisJoint):
    """b turns against a about one axis, as a door on its post."""

    key: ClassVar[str] = "hinge"
    limits: Limits | None = bounds(unit="rad", doc="least and greatest angle")
    motor: AngularMotor | None = part(AngularMotor, doc="turns b")
    friction: float = parameter(unit="N m", doc="greatest torque of friction", default=0.0, least=0.0)

    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Lock everything but the turn about the axis."""
        ways.lock(0, 1, 2, 4, 5)
        ways.limit(3, self.limits)
        ways.drive(3, self.motor)
        ways.rub(self.friction, 3)
