"""Mesh: a closed surface of triangles that does not move."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.systems.shapes.geometry import Geometry, solid_properties
from carom.systems.shapes.shape import Bounds, MassProperties, Shape, Surface


@dataclass(frozen=True)
class Mesh(Shape):
    """A watertight triangle mesh; static, since FCL cannot measure how deep two meshes overlap."""

    key: ClassVar[str] = "mesh"
    number: ClassVar[int] = 7
    static: ClassVar[bool] = True
    geometry: Geometry

    def packed(self) -> tuple[float, ...]:
        """Return zeros: the geometry holds everything."""
        return (0.0,) * 4

    @classmethod
    def from_size(cls, size: Floats, geometry: Any = None) -> Mesh:
        """Return the mesh of ``geometry``."""
        return cls(geometry)

    def mass_properties(self) -> MassProperties:
        """Return the integrals over the enclosed solid, by trimesh."""
        return solid_properties(self.geometry)

    def bounds(self) -> Bounds:
        """Return the box around the vertices."""
        return self.geometry.bounds()

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL bounding-volume hierarchy; it cannot grow, so the margin is left out."""
        import fcl

        model = fcl.BVHModel()
        model.beginModel(len(self.geometry.vertices), len(self.geometry.faces))
        model.addSubModel(np.asarray(self.geometry.vertices), np.asarray(self.geometry.faces))
        model.endModel()
        return model

    def surface(self) -> Surface:
        """Return the triangles."""
        return Surface(self.geometry.vertices, self.geometry.faces, False)
