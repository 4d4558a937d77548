"""Pyramid: layers that are one smaller than those they lie on."""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np
from pydantic import Field

from carom.ecs.column import Integers
from carom.worlds.generators.generator import Copies, Generator, Setting, numbered
from carom.worlds.generators.words import Counts, Gap


class Pyramid(Generator):
    """Copies of an entity in layers, each over the joints of that below, called like ``stone[layer,row,place]``."""

    key: ClassVar[str] = "pyramid"
    sized: ClassVar[bool] = True
    base: Counts = Field(description="copies along the two level axes of the lowest layer; one row makes it flat")
    gap: Gap = Field(0.0, description="left free between neighbours (m)")

    def amount(self) -> int:
        """Return how many copies are asked for, at most."""
        return math.prod(self.base) * min(count for count in self.base if count > 1 or max(self.base) == 1)

    def lay(self, setting: Setting) -> Copies:
        """Return the copies, the lowest layer first."""
        step, (first, second) = setting.size(self.key) + self.gap, setting.across
        layers: list[Integers] = []
        counts = self.base
        while all(counts):
            level = numbered(*reversed(counts))
            layers.append(np.column_stack([np.full(len(level), len(layers)), level]))
            shrinks = [count - (base > 1) for count, base in zip(counts, self.base, strict=True)]
            if max(self.base) == 1:
                break
            counts = (shrinks[0], shrinks[1])
        numbers = np.concatenate(layers)
        positions = np.zeros((len(numbers), 3))
        for axis, column, base in ((first, 2, self.base[0]), (second, 1, self.base[1])):
            shift = 0.5 * numbers[:, 0] if base > 1 else 0.0
            positions[:, axis] = (numbers[:, column] + shift) * step[axis]
        positions[:, setting.up] = numbers[:, 0] * step[setting.up]
        return Copies(positions, numbers)
