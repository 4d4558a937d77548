"""Rope: two points are at most so far from each other."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar, Self

from carom.ecs.components.joint import LIMITED, Joint
from carom.systems.joints.held import Held
from carom.systems.joints.line_joint import LineJoint
from carom.systems.joints.ways import Ways
from carom.systems.parameters import parameter


@dataclass(frozen=True, kw_only=True)
class Rope(LineJoint):
    """The anchors are at most its length from each other; it does nothing while it is slack."""

    key: ClassVar[str] = "rope"
    restitution: float = parameter(unit="1", doc="when it becomes taut", default=0.0, least=0.0, most=1.0)

    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Limit the length; anchors that meet have reached no limit."""
        ways.limit(0, (-math.inf, self.rest(a, b)))

    def columns(self, a: Held, b: Held) -> dict[str, Any]:
        """Return the same as of a line, and how it bounces."""
        return super().columns(a, b) | {"restitution": self.restitution}

    @classmethod
    def of(cls, joint: Joint) -> Self | None:
        """Return what states a joint whose length is bounded from above."""
        if joint.mode[0] != LIMITED:
            return None
        return cls.of_line(joint, length=float(joint.upper[0]), restitution=float(joint.restitution))
