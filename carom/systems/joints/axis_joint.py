"""Joints with an axis, which is x of their frame."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from carom.ecs.spatial import quaternion
from carom.systems.declared import Steps, direction
from carom.systems.joints.frames import X, along_axes, shortest_turn
from carom.systems.joints.held import Held
from carom.systems.joints.kind import Vector
from carom.systems.joints.point_joint import PointJoint
from carom.systems.parameters import parameter


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
