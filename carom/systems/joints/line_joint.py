"""Joints along the line between two anchors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from carom.ecs.components.joint import EULER, LINE, Joint
from carom.ecs.spatial.vector import distance
from carom.systems.declared import Steps
from carom.systems.joints.held import Held
from carom.systems.joints.kind import NOWHERE, JointKind, anchors_of
from carom.systems.parameters import parameter


@dataclass(frozen=True, kw_only=True)
class LineJoint(JointKind):
    """A joint along the line between two anchors, each the origin of its body where it is left out."""

    length: float | None = parameter(unit="m", doc="length, that at the poses stated by default", default=None, above=0)

    def ends(self, a: Held, b: Held) -> tuple[Any, Any]:
        """Return the anchors in the frames of a and b."""
        return self.anchor_a or NOWHERE, self.anchor_b or NOWHERE

    def distance(self, a: Held, b: Held) -> float:
        """Return how far the anchors are from each other, m."""
        end_a, end_b = self.ends(a, b)
        return float(distance(a.outside(end_a), b.outside(end_b)))

    def rest(self, a: Held, b: Held) -> float:
        """Return the length that it has or tends to, m."""
        return self.distance(a, b) if self.length is None else self.length

    @classmethod
    def of_line(cls, joint: Joint, **words: Any) -> Self | None:
        """Return what states a joint along a line with these further words; None for one along axes."""
        if joint.along != LINE:
            return None
        return cls(**anchors_of(joint), break_force=float(joint.break_force), collide=bool(joint.collide), **words)

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
