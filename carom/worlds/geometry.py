"""Meshes and hulls in world files: words for them, and reading them from files beside the world."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field, model_validator

from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import Geometry, hull_of, load_geometry, read_triangles
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.shape import Shape
from carom.worlds.errors import WordError
from carom.worlds.values import In, Vector3, Words

Scale = Annotated[float, In("1", above=0.0)]


class MeshWords(Words):
    """A closed mesh."""

    file: str = Field(description="OBJ, STL, PLY or glTF, relative to the world file")
    scale: Scale = Field(1.0, description="metres per unit of the file")


class ConvexWords(Words):
    """The hull of points, stated or those of a mesh file."""

    points: list[Annotated[Vector3, In("m")]] | None = Field(None, description="points (m)")
    file: str | None = Field(None, description="OBJ, STL, PLY or glTF, relative to the world file")
    scale: Scale = Field(1.0, description="metres per unit of the file")

    @model_validator(mode="after")
    def check(self) -> ConvexWords:
        """Refuse both sources and neither."""
        if (self.points is None) is (self.file is None):
            received = "both" if self.points else "neither"
            raise WordError("must state one source", received=received, accepted="points or file")
        return self


GEOMETRY_WORDS: dict[str, type[Words]] = {Mesh.key: MeshWords, Convex.key: ConvexWords}


class GeometryReader:
    """Reads geometries relative to a folder, each file once."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.known: dict[tuple[str, str, float], Geometry] = {}

    def shape(self, key: str, words: dict[str, Any]) -> Shape:
        """Return the mesh or hull of these words; raise DeclarationError."""
        file, scale = words.get("file"), words.get("scale", 1.0)
        if file is None:
            return Convex(hull_of(np.array(words["points"]).reshape(-1, 3)))
        found = self.known.get((key, file, scale))
        if found is None:
            read = load_geometry if key == Mesh.key else hull_of_file
            found = self.known[key, file, scale] = read(self.folder / file, scale)
        return Mesh(found) if key == Mesh.key else Convex(found)


def hull_of_file(path: Path, scale: float = 1.0) -> Geometry:
    """Return the hull of the vertices of a mesh file, which may be open; raise DeclarationError."""
    return hull_of(np.array(read_triangles(path).vertices) * scale, str(path))
