"""Box."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.systems.kernels.submersion import FOUND, submerge_polyhedra
from carom.systems.shapes.shape import NO_AXES, Bounds, MassProperties, Shape, Surface

CORNERS = np.array(list(product((-0.5, 0.5), repeat=3)))  # of a cube of 1 m
SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
CUBE = CORNERS, np.zeros(8), np.array([(a, *pair) for a, b, c, d in SIDES for pair in ((b, c), (c, d))])


@dataclass(frozen=True)
class Box(Shape):
    """A box with edges along the local axes."""

    key: ClassVar[str] = "box"
    number: ClassVar[int] = 1
    size: tuple[float, float, float] = field(
        metadata={"unit": "m", "doc": "full edge lengths along x, y, z", "above": 0.0, "width": 3}
    )

    def mass_properties(self) -> MassProperties:
        """Return a b c and (b^2 + c^2) / 12."""
        x, y, z = self.size
        moments = ((y * y + z * z) / 12.0, (x * x + z * z) / 12.0, (x * x + y * y) / 12.0)
        return MassProperties(x * y * z, (0.0, 0.0, 0.0), moments, NO_AXES)

    def bounds(self) -> Bounds:
        """Return the half edges."""
        x, y, z = self.size
        return Bounds((0.0, 0.0, 0.0), (x / 2.0, y / 2.0, z / 2.0), 0.0)

    def support(self, directions: Floats) -> Floats:
        """Return the corner, or one of those equally far."""
        return np.asarray(np.where(directions < 0.0, -0.5, 0.5) * self.size)

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL box with its faces moved out by the margin."""
        import fcl

        return fcl.Box(*(edge + 2.0 * margin for edge in self.size))

    def surface(self) -> Surface:
        """Return twelve triangles."""
        from trimesh.creation import box

        mesh = box(extents=self.size)
        return Surface(np.asarray(mesh.vertices), np.asarray(mesh.faces), False)

    def corners(self, towards: tuple[float, float, float]) -> tuple[Floats, float]:
        """Return the eight corners."""
        return np.array(list(product(*((-edge / 2.0, edge / 2.0) for edge in self.size)))), 0.0

    @classmethod
    def submerged(cls, size: Floats, geometry: Any, normal: Floats, depth: Floats) -> Floats:
        """Return those of twelve triangles."""
        found = np.empty((len(depth), FOUND))
        submerge_polyhedra(*CUBE, False, np.ascontiguousarray(size[:, :3]), np.zeros(len(size)), normal, depth, found)
        return found
