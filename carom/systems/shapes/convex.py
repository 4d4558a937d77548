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
from carom.systems.shapes.hull_faces import with_faces
from carom.systems.shapes.model_files import Axis, Unit, load_hull
from carom.systems.shapes.polyhedron import hull_faces
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
        faces: npt.ArrayLike | None = None,
        file: str | Path | None = None,
        scale: float = 1.0,
        unit: Unit = "m",
        up: Axis = "y",
    ) -> Self:
        """Return the hull of ``points`` (n, 3), m, or of the vertices of a file, read by `load_hull`.

        ``faces`` (f, 3) are the triangles of a hull whose vertices the points are; by default they are found. Raises
        DeclarationError where there is no hull, or where it has no `hull_faces` by which to touch.
        """
        shape = cls.seen(points=points, faces=faces, file=file, scale=scale, unit=unit, up=up)
        hull_faces(shape.geometry)
        return shape

    @classmethod
    def seen(cls, *_: Any, points: Any = None, faces: Any = None, file: Any = None, **reading: Any) -> Self:
        """Return what `stated` does, which need not touch."""
        if (points is None) is (file is None):
            raise DeclarationError("convex: must state one source, points or file")
        if file is not None:
            return cls(load_hull(file, **reading))
        hull = hull_of(np.asarray(points, np.float64).reshape(-1, 3))
        return cls(hull if faces is None else with_faces(hull, faces))

    def words(self) -> dict[str, Any]:
        """Return its vertices, and its faces where they are not those that would be found."""
        vertices, faces = self.geometry.vertices, self.geometry.faces
        found = hull_of(vertices)
        alike = np.array_equal(found.vertices, vertices) and np.array_equal(found.faces, faces)
        return {"points": vertices.tolist()} | ({} if alike else {"faces": faces.tolist()})

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL convex; it cannot grow exactly, so the margin is left out."""
        import fcl

        faces = self.geometry.faces
        flat = np.concatenate([np.full((len(faces), 1), 3), faces], axis=1).ravel()
        return fcl.Convex(np.asarray(self.geometry.vertices), len(faces), flat)

    def corners(self, towards: tuple[float, float, float]) -> tuple[Floats, float]:
        """Return the vertices."""
        return self.geometry.vertices, 0.0
