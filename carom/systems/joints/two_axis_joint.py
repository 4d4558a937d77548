"""Joints with two axes, which are x and z of their frame."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from carom.ecs.spatial import vector
from carom.systems.declared import Steps, direction
from carom.systems.joints.axis_joint import AxisJoint
from carom.systems.joints.frames import along_axes
from carom.systems.joints.held import Held
from carom.systems.joints.kind import Vector

PARALLEL = 1e-6  # square of the sine below which two axes say nothing of a plane


@dataclass(frozen=True, kw_only=True)
class TwoAxisJoint(AxisJoint):
    """A joint whose frame has x along the axis and z along the second axis, as far as that is across the first."""

    second_axis: Vector | None = direction(doc="second axis in the world, at the poses stated")

    def misplaced(self, a: Held, b: Held) -> Iterator[tuple[Steps, str]]:
        """Yield that both axes are one."""
        if self.second_axis is not None:
            axis, second = vector.normalise(self.stated_axis(a, b)), vector.normalise(self.second_axis)
            across = vector.cross(axis, second)
            if vector.dot(across, across) < PARALLEL:
                yield ("second_axis",), "must not be along the axis"

    def frame(self, axis: Any) -> Any:
        """Return its frame in the world, given its axis there."""
        return along_axes(axis, self.second_axis)
