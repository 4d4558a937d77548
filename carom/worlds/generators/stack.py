"""Stack: copies one upon another."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from pydantic import Field

from carom.worlds.generators.generator import Copies, Generator, Setting, numbered
from carom.worlds.generators.words import Gap
from carom.worlds.values import Count


class Stack(Generator):
    """Copies of an entity one upon another, called like ``tower[3]`` from below."""

    key: ClassVar[str] = "stack"
    sized: ClassVar[bool] = True
    count: Count = Field(description="how many")
    gap: Gap = Field(0.0, description="left free between neighbours (m)")

    def amount(self) -> int:
        """Return how many copies are asked for."""
        return self.count

    def lay(self, setting: Setting) -> Copies:
        """Return the copies, the lowest first."""
        numbers, step = numbered(self.count), np.zeros(3)
        step[setting.up] = setting.size(self.key)[setting.up] + self.gap
        return Copies(numbers * step, numbers)
