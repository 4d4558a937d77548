"""Framed: a joint as each of the two sees it, which is what every joint at a point comes to."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar, Self

from carom.ecs.components.joint import AXES as ALONG_AXES
from carom.ecs.components.joint import EULER, FREE, LIMITED, SLOTS, SWING_TWIST, Joint
from carom.ecs.spatial.quaternion import IDENTITY
from carom.systems.declared import Steps, flag, numbers
from carom.systems.freedom import AXES
from carom.systems.joints import generic
from carom.systems.joints.generic import angular, linear
from carom.systems.joints.held import Held
from carom.systems.joints.kind import NOWHERE, JointKind, anchors_of
from carom.systems.joints.ways import AngularMotor, AngularWay, LinearMotor, LinearWay, Ways
from carom.systems.parameters import parameter

Rotation = tuple[float, float, float, float]
FARTHEST = 1e-9  # how far from 1 the length of a frame's quaternion may be


@dataclass(frozen=True, kw_only=True)
class Framed(JointKind):
    """Each of six ways as one likes, by anchors and frames as a and b see them: the same joint wherever both are.

    So files state joints that carom writes. Frames are quaternions xyzw, joint to body.
    """

    key: ClassVar[str] = "framed"
    frame_a: Rotation = numbers(4, doc="unit quaternion xyzw, joint to a", default=tuple(IDENTITY.tolist()))
    frame_b: Rotation = numbers(4, doc="unit quaternion xyzw, joint to b", default=tuple(IDENTITY.tolist()))
    swing: bool = flag(doc="whether turns are the twist about x and the angle between both x axes")
    x: str | LinearWay = linear("x")
    y: str | LinearWay = linear("y")
    z: str | LinearWay = linear("z")
    rotation_x: str | AngularWay = angular("x")
    rotation_y: str | AngularWay = angular("y")
    rotation_z: str | AngularWay = angular("z")
    restitution: float = parameter(unit="1", doc="of its limits", default=0.0, least=0.0, most=1.0)
    break_torque: float = parameter(unit="N m", doc="torque beyond which it breaks", default=math.inf, above=0.0)
    place: tuple[float, ...] = numbers(
        SLOTS, doc="where b is against a (m, rad); angles go on beyond a turn", default=(0.0,) * SLOTS
    )

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Yield which frame is no rotation."""
        for name in ("frame_a", "frame_b"):
            length = math.sqrt(sum(part * part for part in getattr(self, name)))
            if abs(length - 1.0) > FARTHEST:
                yield (name,), f"must be a unit quaternion, received one of length {length:.9g}"

    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Do with each way what is stated of it."""
        generic.hold_all(ways, self)

    def columns(self, a: Held, b: Held) -> dict[str, Any]:
        """Return what is stated."""
        return {
            "anchor_a": self.anchor_a or NOWHERE,
            "anchor_b": self.anchor_b or NOWHERE,
            "frame_a": self.frame_a,
            "frame_b": self.frame_b,
            "along": ALONG_AXES,
            "about": SWING_TWIST if self.swing else EULER,
            "position": self.place,
            "restitution": self.restitution,
            "break_torque": self.break_torque,
        }

    @classmethod
    def of(cls, joint: Joint) -> Self | None:
        """Return what states a joint along axes."""
        if joint.along != ALONG_AXES:
            return None
        stated: dict[str, Any] = {name: tuple(getattr(joint, name).tolist()) for name in ("frame_a", "frame_b")}
        stated |= {name: float(getattr(joint, name)) for name in ("restitution", "break_force", "break_torque")}
        stated |= {name: _way(joint, slot) for slot, name in enumerate(AXES)} | anchors_of(joint)
        swing, place = bool(joint.about == SWING_TWIST), tuple(joint.position.tolist())
        return cls(**stated, swing=swing, collide=bool(joint.collide), place=place)


def _way(joint: Joint, slot: int) -> Any:
    """Return what states one way of a joint."""
    mode, kind = int(joint.mode[slot]), LinearWay if slot < 3 else AngularWay
    lower, upper, friction = (float(getattr(joint, name)[slot]) for name in ("lower", "upper", "friction"))
    motor = motor_of(joint, slot) if joint.driven[slot] else None
    bound: dict[str, Any] = {} if mode == FREE else {"limits": (lower, upper)}
    if mode != FREE and math.isinf(lower) != math.isinf(upper):
        bound = {"upper": upper} if math.isinf(lower) else {"lower": lower}
    if mode != LIMITED and motor is None and not friction and not (lower or upper):
        return generic.FREE if mode == FREE else generic.LOCKED
    return kind(**bound, motor=motor, friction=friction)


def motor_of(joint: Joint, slot: int) -> Any:
    """Return what states the spring, damper or motor of one way."""
    names = ("stiffness", "damping", "target", "speed", "most")
    stiffness, damping, target, speed, most = (float(getattr(joint, name)[slot]) for name in names)
    pulls, keeps = stiffness > 0.0, math.isinf(damping)
    return (LinearMotor if slot < 3 else AngularMotor)(
        speed=speed if speed or keeps else None,
        target=target if pulls and target else None,
        stiffness=stiffness if pulls else None,
        damping=None if keeps or (pulls and not damping) else damping,
        most=most,
    )
