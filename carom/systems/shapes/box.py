"""Box."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.systems.shapes.shape import NO_AXES, Bounds, MassProperties, Shape, Surface


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
