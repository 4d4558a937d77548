"""Convex: the hull of points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.systems.shapes.geometry import Geometry, solid_properties
from carom.systems.shapes.shape import Bounds, MassProperties, Shape, Surface


@dataclass(frozen=True)
class Convex(Shape):
    """A convex polyhedron: the hull of the vertices of its geometry."""

    key: ClassVar[str] = "convex"
    number: ClassVar[int] = 6
    geometry: Geometry

    def packed(self) -> tuple[float, ...]:
        """Return zeros: the geometry holds everything."""
        return (0.0,) * 4

    @classmethod
    def from_size(cls, size: Floats, geometry: Any = None) -> Convex:
        """Return the hull of ``geometry``."""
        return cls(geometry)

    def mass_properties(self) -> MassProperties:
        """Return the integrals over the hull, by trimesh."""
        return solid_properties(self.geometry)

    def bounds(self) -> Bounds:
        """Return the box around the vertices."""
        return self.geometry.bounds()

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL convex; it cannot grow exactly, so the margin is left out."""
        import fcl

        faces = self.geometry.faces
        flat = np.concatenate([np.full((len(faces), 1), 3), faces], axis=1).ravel()
        return fcl.Convex(np.asarray(self.geometry.vertices), len(faces), flat)

    def surface(self) -> Surface:
        """Return the faces of the hull."""
        return Surface(self.geometry.vertices, self.geometry.faces, False)

    def corners(self) -> tuple[Floats, float]:
        """Return the vertices."""
        return self.geometry.vertices, 0.0
