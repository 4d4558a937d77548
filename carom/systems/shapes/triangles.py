"""Shapes that are made of triangles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from carom.ecs.column import Floats
from carom.systems.kernels.submersion import FOUND, submerge_polyhedra
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.shape import Bounds, MassProperties, Shape, Surface
from carom.systems.shapes.solid import solid_properties


@dataclass(frozen=True)
class Triangles(Shape):
    """A closed surface of triangles; its geometry holds everything."""

    geometry: Geometry

    def packed(self) -> tuple[float, ...]:
        """Return zeros: there are no numbers beside the geometry."""
        return (0.0,) * 4

    @classmethod
    def from_size(cls, size: Floats, geometry: Any = None) -> Self:
        """Return the shape of ``geometry``."""
        return cls(geometry)

    def words(self) -> dict[str, Any]:
        """Return its vertices and faces."""
        return {"vertices": self.geometry.vertices.tolist(), "faces": self.geometry.faces.tolist()}

    def mass_properties(self) -> MassProperties:
        """Return the integrals over the enclosed solid."""
        return solid_properties(self.geometry)

    def bounds(self) -> Bounds:
        """Return the box around the vertices."""
        return self.geometry.bounds()

    def support(self, directions: Floats) -> Floats:
        """Return the vertex, the first of those equally far."""
        x, y, z = self.geometry.vertices.T
        farthest = [int(np.argmax(a * x + b * y + c * z)) for a, b, c in directions.tolist()]
        return self.geometry.vertices[farthest]

    def surface(self) -> Surface:
        """Return the triangles."""
        return Surface(self.geometry.vertices, self.geometry.faces, False)

    @classmethod
    def submerged(cls, size: Floats, geometry: Any, normal: Floats, depth: Floats) -> Floats:
        """Return those of the triangles."""
        found, stretch = np.empty((len(depth), FOUND)), np.ones((len(depth), 3))
        rest = np.zeros(len(geometry.vertices)), geometry.faces, False, stretch, np.zeros(len(depth))
        submerge_polyhedra(geometry.vertices, *rest, normal, depth, found)
        return found
