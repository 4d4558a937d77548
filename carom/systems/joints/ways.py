"""Ways: what a joint's words say of each of the six ways in which b may move against a, as columns of `Joint`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from carom.ecs.components.joint import FREE, LIMITED, LOCKED, SLOTS, Joint
from carom.systems.declared import Stated, Steps, bounds, part
from carom.systems.parameters import parameter

COLUMNS = ("mode", "lower", "upper", "driven", "stiffness", "damping", "target", "speed", "most", "friction")
Limits = tuple[float, float]


class Motor(Stated):
    """Drives b against a in one way; without spring and damper it keeps its speed."""

    speed: float | None
    target: float | None
    stiffness: float | None
    damping: float | None
    most: float

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Yield what does nothing."""
        if self.target is not None and self.stiffness is None:
            yield ("target",), "a spring pulls to it: state stiffness, or speed in its place"
        elif self.speed is self.stiffness is self.damping is None:
            yield (), "states nothing to do; accepted: speed, target with stiffness, or damping"
        elif self.speed is not None and self.stiffness is not None and not self.damping:
            yield ("speed",), "a damper drives to it beside a spring: state damping"


@dataclass(frozen=True, kw_only=True)
class LinearMotor(Motor):
    """Drives along an axis: at a speed, or to a place by spring and damper."""

    speed: float | None = parameter(unit="m/s", doc="speed of b against a to which it drives", default=None)
    target: float | None = parameter(unit="m", doc="place of b against a to which the spring pulls", default=None)
    stiffness: float | None = parameter(unit="N/m", doc="of the spring towards the target", default=None, above=0.0)
    damping: float | None = parameter(
        unit="N s/m", doc="of the damper towards the speed; without spring it keeps the speed", default=None, least=0.0
    )
    most: float = parameter(unit="N", doc="greatest force", default=math.inf, above=0.0)


@dataclass(frozen=True, kw_only=True)
class AngularMotor(Motor):
    """Drives about an axis: at a speed, or to an angle by spring and damper."""

    speed: float | None = parameter(unit="rad/s", doc="speed of b against a to which it drives", default=None)
    target: float | None = parameter(unit="rad", doc="angle of b against a to which the spring turns", default=None)
    stiffness: float | None = parameter(unit="N m/rad", doc="of the spring towards the target", default=None, above=0.0)
    damping: float | None = parameter(
        unit="N m s/rad",
        doc="of the damper towards the speed; without spring it keeps the speed",
        default=None,
        least=0.0,
    )
    most: float = parameter(unit="N m", doc="greatest torque", default=math.inf, above=0.0)


class Way(Stated):
    """What bounds b in one way."""

    limits: Limits | None
    lower: float | None
    upper: float | None
    motor: Any
    friction: float

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Yield which bound is stated twice."""
        alone = [name for name in ("lower", "upper") if getattr(self, name) is not None]
        if len(alone) == 2:
            yield (), "states lower and upper; state limits: [lower, upper]"
        elif alone and self.limits is not None:
            yield (alone[0],), "is stated beside limits; state one of them"

    def interval(self) -> Limits | None:
        """Return the least and the greatest place, one of which may be infinite; None where nothing bounds it."""
        if self.lower is self.upper is None:
            return self.limits
        return -math.inf if self.lower is None else self.lower, math.inf if self.upper is None else self.upper


@dataclass(frozen=True, kw_only=True)
class LinearWay(Way):
    """How b may move along one axis; what is not stated bounds nothing."""

    limits: Limits | None = bounds(unit="m", doc="least and greatest place")
    lower: float | None = parameter(unit="m", doc="least place where there is no greatest", default=None)
    upper: float | None = parameter(unit="m", doc="greatest place where there is no least", default=None)
    motor: LinearMotor | None = part(LinearMotor, doc="drives along it")
    friction: float = parameter(unit="N", doc="greatest force of friction", default=0.0, least=0.0)


@dataclass(frozen=True, kw_only=True)
class AngularWay(Way):
    """How b may turn about one axis; what is not stated bounds nothing."""

    limits: Limits | None = bounds(unit="rad", doc="least and greatest angle")
    lower: float | None = parameter(unit="rad", doc="least angle where there is no greatest", default=None)
    upper: float | None = parameter(unit="rad", doc="greatest angle where there is no least", default=None)
    motor: AngularMotor | None = part(AngularMotor, doc="turns about it")
    friction: float = parameter(unit="N m", doc="greatest torque of friction", default=0.0, least=0.0)


class Ways:
    """The columns of the six ways of one joint; all are free until something else is said."""

    def __init__(self) -> None:
        self.columns: dict[str, Any] = {}
        for name in COLUMNS:
            column = Joint.columns[name]
            self.columns[name] = np.full(SLOTS, column.default, column.dtype)

    def lock(self, *slots: int, at: float = 0.0) -> None:
        """Let nothing move along or about these, which stay at a place (m, rad)."""
        for slot in slots:
            self._set(slot, mode=LOCKED, lower=at, upper=at)

    def limit(self, slot: int, stated: Limits | None) -> None:
        """Let b go from the lower to the upper place (m, rad), where any are stated."""
        if stated is not None:
            lower, upper = stated
            self._set(slot, mode=LOCKED if lower == upper else LIMITED, lower=lower, upper=upper)

    def drive(self, slot: int, motor: Motor | None) -> None:
        """Let a motor act, where one is stated: without spring and damping it keeps its speed."""
        if motor is not None:
            damping = motor.damping
            if damping is None:
                damping = math.inf if motor.stiffness is None else 0.0
            self._set(
                slot, driven=True, stiffness=motor.stiffness or 0.0, damping=damping,
                target=motor.target or 0.0, speed=motor.speed or 0.0, most=motor.most,
            )  # fmt: skip

    def rub(self, friction: float, *slots: int) -> None:
        """Let friction of at most so much (N, N m) act."""
        for slot in slots:
            self._set(slot, friction=friction)

    def follow(self, slot: int, way: Way) -> None:
        """Let a way be all that is stated of it."""
        self._set(slot, mode=FREE)
        self.limit(slot, way.interval())
        self.drive(slot, way.motor)
        self.rub(way.friction, slot)

    def _set(self, slot: int, **values: float) -> None:
        for name, value in values.items():
            self.columns[name][slot] = value
