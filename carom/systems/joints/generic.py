"""Generic: each of six ways as one likes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from carom.systems.declared import part
from carom.systems.freedom import AXES
from carom.systems.joints.held import Held
from carom.systems.joints.two_axis_joint import TwoAxisJoint
from carom.systems.joints.ways import AngularWay, LinearWay, Ways

FREE, LOCKED = "free", "locked"


def linear(axis: str) -> Any:
    """Declare a way along an axis of the joint's frame."""
    doc = f"along {axis}: free, locked, or what bounds it"
    return part(LinearWay, doc=doc, words=(FREE, LOCKED), default=LOCKED)


def angular(axis: str) -> Any:
    """Declare a way about an axis of the joint's frame."""
    doc = f"about {axis}: free, locked, or what bounds it"
    return part(AngularWay, doc=doc, words=(FREE, LOCKED), default=LOCKED)


@dataclass(frozen=True, kw_only=True)
class Generic(TwoAxisJoint):
    """Each of six ways is free, locked, limited, sprung or driven: along the axes of a's frame, and about them.

    Its frame is x along the axis and z along the second axis; without them, that of the world at the poses stated.
    Turns are angles about x, then y, then z.
    """

    key: ClassVar[str] = "generic"
    x: str | LinearWay = linear("x")
    y: str | LinearWay = linear("y")
    z: str | LinearWay = linear("z")
    rotation_x: str | AngularWay = angular("x")
    rotation_y: str | AngularWay = angular("y")
    rotation_z: str | AngularWay = angular("z")

    def needs_axis(self) -> bool:
        """Tell that the axes of the world will do."""
        return False

    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Do with each way what is stated of it."""
        hold_all(ways, self)


def hold_all(ways: Ways, stated: Any) -> None:
    """Do with each of six ways what a joint states of it."""
    for slot, name in enumerate(AXES):
        way = getattr(stated, name)
        if way == LOCKED:
            ways.lock(slot)
        elif way != FREE:
            ways.follow(slot, way)
