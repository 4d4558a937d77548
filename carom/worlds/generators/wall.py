"""Wall: courses of bricks, every other one shifted by half a brick."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from pydantic import Field

from carom.worlds.generators.generator import Copies, Generator, Setting
from carom.worlds.generators.words import Counts, Gap


class Wall(Generator):
    """Copies of an entity as bricks along x, each over a joint of those below, called like ``brick[course,place]``."""

    key: ClassVar[str] = "wall"
    sized: ClassVar[bool] = True
    count: Counts = Field(description="bricks in the lowest course, and courses; every other course has one less")
    gap: Gap = Field(0.0, description="left free between neighbours (m)")

    def amount(self) -> int:
        """Return how many copies are asked for, those left out among them."""
        return self.count[0] * self.count[1]

    def lay(self, setting: Setting) -> Copies:
        """Return the copies, the lowest course first."""
        bricks, courses = self.count
        course, place = np.indices((courses, bricks))
        kept = place < bricks - course % 2
        numbers = np.column_stack([course[kept], place[kept]])
        step = setting.size(self.key) + self.gap
        positions = np.zeros((len(numbers), 3))
        positions[:, setting.across[0]] = (numbers[:, 1] + 0.5 * (numbers[:, 0] % 2)) * step[setting.across[0]]
        positions[:, setting.up] = numbers[:, 0] * step[setting.up]
        return Copies(positions, numbers)
