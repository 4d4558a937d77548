"""Kinds of joints: the declaration each makes in a file of its own, and their registry."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.ecs.components.joint import AXES, EULER, LINE, Joint
from carom.ecs.spatial import quaternion
from carom.ecs.spatial.vector import distance
from carom.systems.joints.declared import Stated, Steps, direction, flag, whom
from carom.systems.joints.frames import X, along_axes, shortest_turn
from carom.systems.joints.held import Held
from carom.systems.joints.ways import Ways
from carom.systems.parameters import parameter, vector
from carom.systems.registry import enter

JOINTS: dict[str, type[JointKind]] = {}
Vector = tuple[float, float, float]
NO_ANCHOR = "states no anchor; accepted: at (world frame), anchor_a or anchor_b (frames of the bodies)"


@dataclass(frozen=True, kw_only=True)
class JointKind(Stated, ABC):
    """What holds b to a; ``key`` is its word in files, and its words are declared fields.

    Angles and distances are those of b against a, and 0 at the poses at which the joint is stated.
    """

    key: ClassVar[str] = ""
    a: Any = whom(doc="who holds, the world by default")
    b: Any = whom(doc="who is held, the world by default")
    anchor_a: Vector | None = vector(unit="m", doc="anchor in the frame of a", default=None)
    anchor_b: Vector | None = vector(unit="m", doc="anchor in the frame of b", default=None)
    break_force: float = parameter(unit="N", doc="force beyond which it breaks", default=math.inf, above=0.0)
    collide: bool = flag(doc="whether a and b touch each other")

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "key" in vars(cls):
            enter(JOINTS, cls.key, cls, clash="joints have the key", mend="give one of them another key")

    def joint(self, a: Held, b: Held) -> Joint:
        """Return the component, the anchors and frames being where both are now."""
        ways = Ways()
        self.hold(ways, a, b)
        shared = {name: getattr(self, name) for name in ("break_force", "collide")}
        return Joint(a=a.entity, b=b.entity, **shared, **self.columns(a, b), **ways.columns)

    @abstractmethod
    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Say which ways are locked, limited, driven and rubbed."""

    @abstractmethod
    def columns(self, a: Held, b: Held) -> dict[str, Any]:
        """Return where it is anchored, what it measures along and about, and the place of b."""

    def misplaced(self, a: Held, b: Held) -> Iterator[tuple[Steps, str]]:
        """Yield what is wrong with its words for those whom it holds, as `faults` does."""
        yield from ()


@dataclass(frozen=True, kw_only=True)
class PointJoint(JointKind):
    """A joint at a point of both."""

    at: Vector | None = vector(unit="m", doc="anchor in the world, at the poses stated", default=None)
    break_torque: float = parameter(unit="N m", doc="torque beyond which it breaks", default=math.inf, above=0.0)
    about: ClassVar[int] = EULER

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Yield that there is no anchor, or too many."""
        local = [name for name in ("anchor_a", "anchor_b") if getattr(self, name) is not None]
        if self.at is None and not local:
            yield (), NO_ANCHOR
        if self.at is not None and local:
            yield ("at",), f"is stated beside {' and '.join(local)}; state one of them"

    def columns(self, a: Held, b: Held) -> dict[str, Any]:
        """Return anchors and frames; of what is stated of one side, the other is where it meets it."""
        of_a = None if self.anchor_a is None else a.outside(self.anchor_a)
        of_b = None if self.anchor_b is None else b.outside(self.anchor_b)
        place_a, place_b = (
            next(np.asarray(place, np.float64) for place in places if place is not None)
            for places in ((of_a, of_b, self.at), (of_b, of_a, self.at))
        )
        turned_a, turned_b = self.frames(a, b)
        place = np.zeros(6)
        place[:3] = quaternion.rotate(quaternion.conjugate(turned_a), place_b - place_a)
        return {
            "anchor_a": a.inside(place_a),
            "anchor_b": b.inside(place_b),
            "frame_a": quaternion.multiply(quaternion.conjugate(a.rotation), turned_a),
            "frame_b": quaternion.multiply(quaternion.conjugate(b.rotation), turned_b),
            "along": AXES,
            "about": self.about,
            "position": place,
            "break_torque": self.break_torque,
        }

    def frames(self, a: Held, b: Held) -> tuple[Any, Any]:
        """Return the rotations of its frame in the world, as a and as b see it."""
        return quaternion.IDENTITY, quaternion.IDENTITY


@dataclass(frozen=True, kw_only=True)
class AxisJoint(PointJoint):
    """A joint with an axis, which is x of its frame."""

    axis: Vector | None = direction(doc="axis in the world, at the poses stated")
    axis_a: Vector | None = direction(doc="axis in the frame of a")
    axis_b: Vector | None = direction(doc="axis in the frame of b")
    restitution: float = parameter(unit="1", doc="of its limits", default=0.0, least=0.0, most=1.0)

    def needs_axis(self) -> bool:
        """Tell whether it means nothing without an axis."""
        return True

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Yield that there is no axis, or too many."""
        yield from super().faults()
        local = [name for name in ("axis_a", "axis_b") if getattr(self, name) is not None]
        if self.needs_axis() and self.axis is None and not local:
            yield (), "states no axis; accepted: axis (world frame), axis_a or axis_b (frames of the bodies)"
        if self.axis is not None and local:
            yield ("axis",), f"is stated beside {' and '.join(local)}; state one of them"

    def columns(self, a: Held, b: Held) -> dict[str, Any]:
        """Return the same as of a point, and how it bounces."""
        return super().columns(a, b) | {"restitution": self.restitution}

    def frames(self, a: Held, b: Held) -> tuple[Any, Any]:
        """Return frames with x along the axis; where both state it, b's is a's by the shortest turn."""
        frame = self.frame(self.stated_axis(a, b))
        if self.axis_a is None or self.axis_b is None:
            return frame, frame
        turn = shortest_turn(quaternion.rotate(a.rotation, self.axis_a), quaternion.rotate(b.rotation, self.axis_b))
        return frame, quaternion.multiply(turn, frame)

    def stated_axis(self, a: Held, b: Held) -> Any:
        """Return the axis in the world, that of a where both state one, and x where none is stated."""
        if self.axis_a is not None:
            return quaternion.rotate(a.rotation, self.axis_a)
        if self.axis_b is not None:
            return quaternion.rotate(b.rotation, self.axis_b)
        return X if self.axis is None else self.axis

    def frame(self, axis: Any) -> Any:
        """Return its frame in the world, given its axis there."""
        return along_axes(axis)


@dataclass(frozen=True, kw_only=True)
class LineJoint(JointKind):
    """A joint along the line between two anchors, each the origin of its body where it is left out."""

    length: float | None = parameter(unit="m", doc="length, that at the poses stated by default", default=None, above=0)

    def ends(self, a: Held, b: Held) -> tuple[Any, Any]:
        """Return the anchors in the frames of a and b."""
        nowhere = (0.0, 0.0, 0.0)
        return self.anchor_a or nowhere, self.anchor_b or nowhere

    def distance(self, a: Held, b: Held) -> float:
        """Return how far the anchors are from each other, m."""
        end_a, end_b = self.ends(a, b)
        return float(distance(a.outside(end_a), b.outside(end_b)))

    def rest(self, a: Held, b: Held) -> float:
        """Return the length that it has or tends to, m."""
        return self.distance(a, b) if self.length is None else self.length

    def misplaced(self, a: Held, b: Held) -> Iterator[tuple[Steps, str]]:
        """Yield that an end in the world is nowhere, or that no length is stated of what has none."""
        ends = [name for name, side in (("anchor_a", a), ("anchor_b", b)) if side.entity < 0]
        missing = [name for name in ends if getattr(self, name) is None]
        for name in missing:
            yield (), f"its end in the world is nowhere; state {name}"
        if not missing and not self.rest(a, b) > 0.0:
            yield (), "its anchors are at one place; state length, or hold a point by a ball"

    def columns(self, a: Held, b: Held) -> dict[str, Any]:
        """Return the anchors, and how far they are from each other."""
        end_a, end_b = self.ends(a, b)
        place = np.zeros(6)
        place[0] = self.distance(a, b)
        return {"anchor_a": end_a, "anchor_b": end_b, "along": LINE, "about": EULER, "position": place}
