"""Distance: two points stay as far from each other as they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

from carom.ecs.components.joint import LOCKED, Joint
from carom.systems.joints.held import Held
from carom.systems.joints.line_joint import LineJoint
from carom.systems.joints.ways import Ways


@dataclass(frozen=True, kw_only=True)
class Distance(LineJoint):
    """The anchors stay as far from each other as they are, as by a rod that weighs nothing."""

    key: ClassVar[str] = "distance"

    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Lock the length."""
        ways.lock(0, at=self.rest(a, b))

    @classmethod
    def of(cls, joint: Joint) -> Self | None:
        """Return what states a joint whose length is locked."""
        return cls.of_line(joint, length=float(joint.lower[0])) if joint.mode[0] == LOCKED else None
