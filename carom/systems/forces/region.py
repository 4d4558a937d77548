"""Regions: parts of space, for laws that act only there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from carom.ecs.column import Booleans, Floats
from carom.systems.declared import Stated, Steps, part
from carom.systems.parameters import parameter, vector


@dataclass(frozen=True)
class BoxRegion(Stated):
    """What lies in a box along the axes of the world, its faces included."""

    size: tuple[float, float, float] = vector(unit="m", doc="full edge lengths along x, y, z", above=0.0)
    position: tuple[float, float, float] = vector(unit="m", doc="its middle", default=(0.0, 0.0, 0.0))

    def contains(self, points: Floats) -> Booleans:
        """Tell which points (n, 3) in m are inside."""
        return np.asarray((np.abs(points - self.position) <= self.half).all(axis=1))

    @property
    def half(self) -> Floats:
        """Half its size (3,), m."""
        return 0.5 * np.array(self.size)


@dataclass(frozen=True)
class SphereRegion(Stated):
    """What lies in a sphere, its surface included."""

    radius: float = parameter(unit="m", doc="radius", above=0.0)
    position: tuple[float, float, float] = vector(unit="m", doc="its centre", default=(0.0, 0.0, 0.0))

    def contains(self, points: Floats) -> Booleans:
        """Tell which points (n, 3) in m are inside."""
        away = points - self.position
        return np.asarray((away * away).sum(axis=1) <= self.radius * self.radius)

    @property
    def half(self) -> Floats:
        """Half the edges (3,), m, of the box around it."""
        return np.full(3, self.radius)


@dataclass(frozen=True)
class Region(Stated):
    """A part of space: exactly one shape, in the frame of the world."""

    box: BoxRegion | None = part(BoxRegion, doc="a box along the axes of the world")
    sphere: SphereRegion | None = part(SphereRegion, doc="a sphere")

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Refuse none and both."""
        if (self.box is None) is (self.sphere is None):
            yield (), "must state exactly one shape, box or sphere"

    def contains(self, points: Floats) -> Booleans:
        """Tell which points (n, 3) in m, world frame, are in it; of each the answer depends on nothing but itself."""
        return self._shape.contains(points)

    def bounds(self) -> tuple[Floats, Floats]:
        """Return the lower and the upper corner (3,) of the box around it, m."""
        middle = np.array(self._shape.position)
        return middle - self._shape.half, middle + self._shape.half

    @property
    def _shape(self) -> BoxRegion | SphereRegion:
        shape = self.box or self.sphere
        assert shape is not None, "faults() finds regions without a shape"
        return shape
