"""Convex: the hull of points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.systems.shapes.triangles import Triangles


@dataclass(frozen=True)
class Convex(Triangles):
    """A convex polyhedron; make its geometry with `hull_of`."""

    key: ClassVar[str] = "convex"
    number: ClassVar[int] = 6

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL convex; it cannot grow exactly, so the margin is left out."""
        import fcl

        faces = self.geometry.faces
        flat = np.concatenate([np.full((len(faces), 1), 3), faces], axis=1).ravel()
        return fcl.Convex(np.asarray(self.geometry.vertices), len(faces), flat)

    def corners(self, towards: tuple[float, float, float]) -> tuple[Floats, float]:
        """Return the vertices."""
        return self.geometry.vertices, 0.0
