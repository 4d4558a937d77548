"""Slider: moves along one axis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from carom.systems.declared import bounds, part
from carom.systems.joints.axis_joint import AxisJoint
from carom.systems.joints.held import Held
from carom.systems.joints.ways import Limits, LinearMotor, Ways
from carom.systems.parameters import parameter


@dataclass(frozen=True, kw_only=True)
class Slider(AxisJoint):
    """b moves against a along one axis and does not turn, as a drawer."""

    key: ClassVar[str] = "slider"
    limits: Limits | None = bounds(unit="m", doc="least and greatest distance along the axis")
    motor: LinearMotor | None = part(LinearMotor, doc="moves b")
    friction: float = parameter(unit="N", doc="greatest force of friction", default=0.0, least=0.0)

    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Lock everything but the way along the axis."""
        ways.lock(1, 2, 3, 4, 5)
        ways.limit(0, self.limits)
        ways.drive(0, self.motor)
        ways.rub(self.friction, 0)
