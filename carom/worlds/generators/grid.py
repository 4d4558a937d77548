"""Grid: copies in rows, columns and layers."""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np
from pydantic import Field

from carom.worlds.generators.generator import Copies, Generator, Setting, numbered
from carom.worlds.values import Count, Length, Lengths, either


class Grid(Generator):
    """Copies of an entity on a grid, called like ``rain[3,0,1]``."""

    key: ClassVar[str] = "grid"
    count: tuple[Count, Count, Count] = Field(description="copies along x, y and z")
    spacing: either(Length, Lengths, list) = Field(description="distance between neighbours (m), one or one per axis")  # type: ignore[valid-type]
    origin: Lengths = Field((0.0, 0.0, 0.0), description="where copy [0,0,0] is, added to transform.position (m)")

    def amount(self) -> int:
        """Return how many copies are asked for."""
        return math.prod(self.count)

    def lay(self, setting: Setting) -> Copies:
        """Return the copies, the last axis running first."""
        numbers = numbered(*self.count)
        return Copies(np.asarray(self.origin) + numbers * np.asarray(self.spacing), numbers)
