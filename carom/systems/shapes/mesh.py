"""Mesh: a closed surface of triangles that does not move."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats, Integers
from carom.ecs.errors import DeclarationError
from carom.systems.shapes.finish import Part, load_seen
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.model_files import Axis, Unit, closed_surface, load_mesh, triangles
from carom.systems.shapes.triangles import Triangles
from carom.systems.shapes.welding import seams


@dataclass(frozen=True)
class Mesh(Triangles):
    """A watertight triangle mesh; static, since FCL cannot measure how deep two meshes overlap.

    Every shape meets it by kernels, also where ``collision: fcl`` lets none stand in elsewhere: FCL's answers of meshes
    are wrong beyond what can be guarded. Round bodies are round on it, to the last digit: cylinders roll.
    """

    key: ClassVar[str] = "mesh"
    number: ClassVar[int] = 7
    static: ClassVar[bool] = True

    @classmethod
    def stated(
        cls,
        *,
        file: str | Path | None = None,
        vertices: npt.ArrayLike | None = None,
        faces: npt.ArrayLike = (),
        scale: float = 1.0,
        unit: Unit = "m",
        up: Axis = "y",
    ) -> Self:
        """Return the mesh of a file, read by `load_mesh`, or of ``vertices`` (v, 3), m, and ``faces`` (f, 3)."""
        if file is not None:
            return cls(load_mesh(file, scale=scale, unit=unit, up=up))
        return cls(closed_surface(*_stated(vertices, faces), cls.key, cls.key))

    @classmethod
    def seen(
        cls,
        *,
        file: str | Path | None = None,
        vertices: npt.ArrayLike | None = None,
        faces: npt.ArrayLike = (),
        scale: float = 1.0,
        unit: Unit = "m",
        up: Axis = "y",
    ) -> Self:
        """Return the mesh of a file as it looks, read by `load_seen`, or of stated triangles, which may be open."""
        if file is not None:
            return cls(load_seen(file, scale=scale, unit=unit, up=up))
        places, corners = _stated(vertices, faces)
        return cls(Geometry(places, corners, cls.key, parts=(Part(places, corners, None),)))

    @classmethod
    def submerged(cls, size: Floats, geometry: Any, normal: Floats, depth: Floats) -> Floats:
        """Return those of the triangles; raise DeclarationError where they do not close a volume."""
        if loose := seams(geometry.faces, len(geometry.vertices)).loose:
            raise DeclarationError(
                f"{geometry.source or cls.key} is open: {loose} edges do not join two faces, so it has no volume; "
                "close its holes, or use convex"
            )
        return super().submerged(size, geometry, normal, depth)

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL bounding-volume hierarchy; it cannot grow, so the margin is left out."""
        import fcl

        model = fcl.BVHModel()
        model.beginModel(len(self.geometry.vertices), len(self.geometry.faces))
        model.addSubModel(np.asarray(self.geometry.vertices), np.asarray(self.geometry.faces))
        model.endModel()
        return model


def _stated(vertices: npt.ArrayLike | None, faces: npt.ArrayLike) -> tuple[Floats, Integers]:
    if vertices is None:
        raise DeclarationError("mesh: must state one source, file or vertices")
    return triangles("mesh", vertices, faces)
