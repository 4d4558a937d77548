"""Joints at a point of both bodies."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.ecs.components.joint import AXES, EULER
from carom.ecs.spatial import quaternion
from carom.systems.declared import Steps
from carom.systems.joints.held import Held
from carom.systems.joints.kind import JointKind, Vector
from carom.systems.parameters import parameter, vector

NO_ANCHOR = "states no anchor; accepted: at (world frame), anchor_a or anchor_b (frames of the bodies)"


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
