"""Fixed: nothing moves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from carom.systems.joints.held import Held
from carom.systems.joints.point_joint import PointJoint
from carom.systems.joints.ways import Ways


@dataclass(frozen=True, kw_only=True)
class Fixed(PointJoint):
    """b stays at its pose against a, as if glued."""

    key: ClassVar[str] = "fixed"

    def hold(self, ways: Ways, a: Held, b: Held) -> None:
        """Lock everything."""
        ways.lock(0, 1, 2, 3, 4, 5)
