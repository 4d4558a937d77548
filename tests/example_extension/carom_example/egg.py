"""Egg: an ellipsoid that is round about its axis."""

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.systems.shapes.shape import NO_AXES, Bounds, MassProperties, Shape, Surface, parameter


@dataclass(frozen=True)
class Egg(Shape):
    """An egg along y."""

    key: ClassVar[str] = "egg"
    radius: float = parameter(unit="m", doc="radius at its widest", above=0.0)
    length: float = parameter(unit="m", doc="from end to end", above=0.0)

    def mass_properties(self) -> MassProperties:
        """Return 4/3 pi r^2 h with h half the length, and (r^2 + h^2) / 5 across, 2/5 r^2 about the axis."""
        r, h = self.radius, self.length / 2.0
        across, about = (r * r + h * h) / 5.0, 0.4 * r * r
        return MassProperties(4.0 / 3.0 * math.pi * r * r * h, (0.0, 0.0, 0.0), (across, about, across), NO_AXES)

    def bounds(self) -> Bounds:
        """Return the half axes."""
        return Bounds((0.0, 0.0, 0.0), (self.radius, self.length / 2.0, self.radius), 0.0)

    def support(self, directions: Floats) -> Floats:
        """Return R^2 d / |R d| with the half axes R."""
        half = np.array([self.radius, self.length / 2.0, self.radius])
        stretched = directions * half
        return np.asarray(stretched * half / np.sqrt((stretched * stretched).sum(axis=1, keepdims=True)))

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return FCL's ellipsoid; it cannot grow exactly, so the margin is left out."""
        import fcl

        return fcl.Ellipsoid(self.radius, self.length / 2.0, self.radius)

    def surface(self) -> Surface:
        """Return a stretched ball."""
        from trimesh.creation import icosphere

        ball = icosphere(subdivisions=3)
        half = np.array([self.radius, self.length / 2.0, self.radius])
        return Surface(np.asarray(ball.vertices) * half, np.asarray(ball.faces), True)
