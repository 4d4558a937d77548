"""Ring: copies on a level circle."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field

from carom.ecs.spatial import angles, quaternion
from carom.worlds.generators.generator import Copies, Generator, Setting, numbered
from carom.worlds.generators.words import Edge
from carom.worlds.values import Count, Flag, In

FARTHEST_START = 1e6  # rad; the sine of far larger angles has no digit worth having


class Ring(Generator):
    """Copies of an entity on a level circle about where it is, called like ``seat[3]``."""

    key: ClassVar[str] = "ring"
    count: Count = Field(description="how many")
    radius: Edge = Field(description="of the circle (m)")
    start: Annotated[float, In("rad", least=-FARTHEST_START, most=FARTHEST_START)] = Field(
        0.0, description="where the first is; 0 is +x, anticlockwise from above"
    )
    turned: Flag = Field(True, description="whether each is turned with its place, or all are alike")

    def amount(self) -> int:
        """Return how many copies are asked for."""
        return self.count

    def lay(self, setting: Setting) -> Copies:
        """Return the copies, anticlockwise as seen from above."""
        numbers = numbered(self.count)
        angle = self.start + numbers[:, 0] * (2.0 * math.pi / self.count)
        sine, cosine = angles.sines_cosines(angle)
        first, second = setting.across
        positions, axis = np.zeros((self.count, 3)), np.zeros(3)
        positions[:, first] = self.radius * cosine
        positions[:, second] = self.radius * (-sine if setting.up == 1 else sine)
        axis[setting.up] = 1.0
        rotations = quaternion.from_axis_angle(np.broadcast_to(axis, (self.count, 3)), angle) if self.turned else None
        return Copies(positions, numbers, rotations)
