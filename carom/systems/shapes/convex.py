"""Convex: the hull of points."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.errors import DeclarationError
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.model_files import Axis, Unit, load_hull
from carom.systems.shapes.triangles import Triangles


@dataclass(frozen=True)
class Convex(Triangles):
    """A convex polyhedron; `stated` makes its geometry."""

    key: ClassVar[str] = "convex"
    number: ClassVar[int] = 6

    @classmethod
    def stated(
        cls,
        *,
        points: npt.ArrayLike | None = None,
        file: str | Path | None = None,
        scale: float = 1.0,
        unit: Unit = "m",
        up: Axis = "y",
    ) -> Self:
        """Return the hull of ``points`` (n, 3), m, or of the vertices of a file, read by `load_hull`."""
        if (points is None) is (file is None):
            raise DeclarationError("convex: must state one source, points or file")
        if file is not None:
            return cls(load_hull(file, scale=scale, unit=unit, up=up))
        return cls(hull_of(np.asarray(points, np.float64).reshape(-1, 3)))

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL convex; it cannot grow exactly, so the margin is left out."""
        import fcl

        faces = self.geometry.faces
        flat = np.concatenate([np.full((len(faces), 1), 3), faces], axis=1).ravel()
        return fcl.Convex(np.asarray(self.geometry.vertices), len(faces), flat)

    def corners(self, towards: tuple[float, float, float]) -> tuple[Floats, float]:
        """Return the vertices."""
        return self.geometry.vertices, 0.0
