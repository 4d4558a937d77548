"""Point: a particle that collides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.systems.constants import LEAST_FCL_RADIUS
from carom.systems.shapes.shape import NO_AXES, Bounds, MassProperties, Shape, Surface

DRAWN_RADIUS = 0.01


@dataclass(frozen=True)
class Point(Shape):
    """A point mass: it has no extent, does not rotate, and needs a stated mass."""

    key: ClassVar[str] = "point"
    number: ClassVar[int] = 3
    solid: ClassVar[bool] = False

    def mass_properties(self) -> MassProperties:
        """Return nothing but zeros."""
        return MassProperties(0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), NO_AXES)

    def bounds(self) -> Bounds:
        """Return a point."""
        return Bounds((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0)

    def support(self, directions: Floats) -> Floats:
        """Return the point itself."""
        return np.zeros_like(directions)

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return a sphere of the margin, since FCL has no points."""
        import fcl

        return fcl.Sphere(max(margin, LEAST_FCL_RADIUS))

    def surface(self) -> Surface:
        """Return a small ball of 1 cm, so that the point can be seen."""
        from trimesh.creation import icosphere

        mesh = icosphere(subdivisions=1, radius=DRAWN_RADIUS)
        return Surface(np.asarray(mesh.vertices), np.asarray(mesh.faces), True)

    def corners(self, towards: tuple[float, float, float]) -> tuple[Floats, float]:
        """Return the point itself."""
        return np.zeros((1, 3)), 0.0
