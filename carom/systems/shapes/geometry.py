"""Geometries: triangle data shared by colliders and visuals, kept once per content."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.errors import DeclarationError
from carom.systems.shapes.shape import Bounds

FLATTEST = 1e-9  # part of their width that points must leave a plane by to have a volume


@dataclass(frozen=True, eq=False)
class Geometry:
    """Vertices (v, 3) in m and outward faces (f, 3); ``source`` says where they came from."""

    vertices: Floats
    faces: Integers
    source: str = ""

    def bounds(self) -> Bounds:
        """Return the axis-aligned box around the vertices."""
        lower, upper = self.vertices.min(axis=0), self.vertices.max(axis=0)
        center, half = (lower + upper) / 2.0, (upper - lower) / 2.0
        return Bounds(tuple(map(float, center)), tuple(map(float, half)), 0.0)  # type: ignore[arg-type]

    def content(self) -> bytes:
        """Return what makes two geometries the same."""
        return self.vertices.tobytes() + self.faces.tobytes()


@dataclass
class Geometries(Resource):
    """The geometries of a world by number."""

    items: list[Geometry] = field(default_factory=list)
    numbers: dict[bytes, int] = field(default_factory=dict)

    def number(self, geometry: Geometry) -> int:
        """Return the number of this content, adding it when new."""
        return self.numbers.setdefault(geometry.content(), self._append(geometry))

    def _append(self, geometry: Geometry) -> int:
        known = self.numbers.get(geometry.content())
        if known is not None:
            return known
        self.items.append(geometry)
        return len(self.items) - 1


def hull_of(points: Floats, source: str = "points") -> Geometry:
    """Return the convex hull of points (n, 3); raise DeclarationError when they span no volume."""
    from scipy.spatial import QhullError
    from trimesh.convex import convex_hull

    points = np.asarray(points, np.float64)
    if len(points) < 4:
        raise DeclarationError(f"{source}: a convex hull needs at least 4 points, received {len(points)}")
    if not np.isfinite(points).all():
        bad = int(np.nonzero(~np.isfinite(points).all(axis=1))[0][0])
        raise DeclarationError(f"{source}: points must be finite, received {points[bad].tolist()} as point {bad}")
    flat = DeclarationError(f"{source}: the points lie in one plane, so their hull has no volume")
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    if spread[2] <= FLATTEST * spread[0]:  # qhull would joggle them into a hull
        raise flat
    try:
        hull = convex_hull(points)
    except (QhullError, ValueError):
        raise flat from None
    return Geometry(np.array(hull.vertices, np.float64), np.array(hull.faces, np.int64), source)


def read_triangles(path: Path) -> Any:
    """Return the trimesh of an OBJ, STL, PLY or glTF file; raise DeclarationError when it is missing or unreadable."""
    import trimesh

    if not path.is_file():
        raise DeclarationError(f"mesh file {path} does not exist")
    try:
        return trimesh.load_mesh(path)
    except Exception as fault:
        raise DeclarationError(f"mesh file {path} cannot be read: {fault}") from None


def load_geometry(path: Path, scale: float = 1.0) -> Geometry:
    """Read a closed mesh from OBJ, STL, PLY or glTF; ``scale`` turns its unit into m.

    Raises DeclarationError when the file is missing or unreadable, holds no triangles, or is open or inverted.
    """
    mesh = read_triangles(path)
    if not len(getattr(mesh, "faces", ())):
        raise DeclarationError(f"mesh file {path} holds no triangles")
    if not mesh.is_watertight:
        raise DeclarationError(
            f"mesh file {path} is open: {len(mesh.faces)} faces do not close a volume; close its holes, or use convex"
        )
    if mesh.volume <= 0.0:
        raise DeclarationError(
            f"mesh file {path} is inverted: its volume is {mesh.volume * scale**3:.6g} m3; turn its faces outward"
        )
    return Geometry(np.array(mesh.vertices * scale, np.float64), np.array(mesh.faces, np.int64), str(path))
