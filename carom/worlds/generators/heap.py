"""Heap: copies turned at random, in layers above each other, to fall into a heap."""

from __future__ import annotations

from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field

from carom.ecs.errors import DeclarationError
from carom.worlds.generators.generator import MOST_COPIES, Copies, Generator, Setting, turns
from carom.worlds.generators.words import Gap
from carom.worlds.values import Count, In


class Heap(Generator):
    """Copies of an entity turned at random that fall into a heap, called like ``stone[3]`` from below."""

    key: ClassVar[str] = "heap"
    sized: ClassVar[bool] = True
    count: Count = Field(description="how many")
    area: Annotated[tuple[float, float], In("m", above=0.0)] = Field(
        description="edges of the level rectangle above which they are, about where the entity is (m)"
    )
    gap: Gap = Field(0.0, description="left free between neighbours at most (m); each is moved by up to half of it")

    def amount(self) -> int:
        """Return how many copies are asked for."""
        return self.count

    def lay(self, setting: Setting) -> Copies:
        """Return the copies, the lowest layer first: none reaches into the cell of another."""
        edge = 2.0 * setting.radius(self.key) + self.gap
        wide, deep = (int(min(length / edge, MOST_COPIES)) for length in self.area)  # however vast the area
        if not wide * deep:
            raise DeclarationError(f"heap.area: leaves no room for a copy, which needs {edge:.3g} m each way")
        number = np.arange(self.count)
        first, second = setting.across
        positions = np.zeros((self.count, 3))
        positions[:, first] = (number % wide - 0.5 * (wide - 1)) * edge
        positions[:, second] = (number // wide % deep - 0.5 * (deep - 1)) * edge
        positions[:, setting.up] = (number // (wide * deep) + 0.5) * edge
        positions += setting.draws.uniform(-0.5 * self.gap, 0.5 * self.gap, positions.shape)
        return Copies(positions, number[:, None], turns(setting.draws, self.count))
