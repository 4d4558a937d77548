"""Universal: turns about two axes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from carom.systems.declared import Steps, bounds, part
from carom.systems.joints.held import Held
from carom.systems.joints.two_axis_joint import TwoAxisJoint
from carom.systems.joints.ways import AngularMotor, Limits, Ways
from carom.systems.parameters import parameter


@dataclass(frozen=True, kw_only=True)
class Universal(TwoAxisJoint):
    """b turns about two axes across each other, the first fixed in a and the second in b, as on a Cardan shaft."""

    key: ClassVar[str] = "universal"
    limits: Limits | None = bounds(unit="rad", doc="least and greatest angle about the axis")
    second_limits: Limits | None = bounds(unit="rad", doc="least and greatest angle about the second axis")
    motor: AngularMotor | None = part(AngularMotor, doc="turns b about the axis")
    second_motor: AngularMotor | None = part(AngularMotor, doc="turns b about the second axis")
    friction: float = parameter(unit="N m", doc="greatest torque of friction about each", default=0.0, least=0.0)

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Yield that there is no second axis."""
        yield from super().faults()
        if self.second_axis is None:
            yield ("second_axis",), "is missing; it is fixed in b and across the axis"

    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Lock everything but the turns about x of a and z of b."""
        ways.lock(0, 1, 2, 4)
        for slot, stated, motor in ((3, self.limits, self.motor), (5, self.second_limits, self.second_motor)):
            ways.limit(slot, stated)
            ways.drive(slot, motor)
        ways.rub(self.friction, 3, 5)
