"""Line: copies one step from each other."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from pydantic import Field

from carom.worlds.generators.generator import Copies, Generator, Setting, numbered
from carom.worlds.values import Count, Lengths


class Line(Generator):
    """Copies of an entity in a row, called like ``post[3]``."""

    key: ClassVar[str] = "line"
    count: Count = Field(description="how many")
    step: Lengths = Field(description="from each to the next (m)")

    def amount(self) -> int:
        """Return how many copies are asked for."""
        return self.count

    def lay(self, setting: Setting) -> Copies:
        """Return the copies from the first on."""
        numbers = numbered(self.count)
        return Copies(numbers * np.asarray(self.step), numbers)
