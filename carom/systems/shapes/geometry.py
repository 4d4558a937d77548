"""Geometries: triangle data shared by colliders and visuals, kept once per content."""

from __future__ import annotations

from dataclasses import dataclass, field
from hashlib import blake2b
from typing import TYPE_CHECKING

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.errors import DeclarationError
from carom.systems.constants import FLATTEST_HULL
from carom.systems.shapes.shape import Bounds

if TYPE_CHECKING:
    from carom.systems.shapes.finish import Part


@dataclass(frozen=True, eq=False)
class Geometry:
    """Vertices (v, 3) in m and outward faces (f, 3).

    ``source`` says where they came from, ``notes`` what of that was left out, ``parts`` how they look.
    """

    vertices: Floats
    faces: Integers
    source: str = ""
    notes: tuple[str, ...] = ()
    parts: tuple[Part, ...] = ()

    def bounds(self) -> Bounds:
        """Return the axis-aligned box around the vertices."""
        lower, upper = self.vertices.min(axis=0), self.vertices.max(axis=0)
        center, half = (lower + upper) / 2.0, (upper - lower) / 2.0
        return Bounds(tuple(map(float, center)), tuple(map(float, half)), 0.0)  # type: ignore[arg-type]

    def content(self) -> bytes:
        """Return a digest that is the same for the same triangles that look alike."""
        digest = blake2b(np.array(self.vertices.shape).tobytes(), digest_size=32)
        for array in (self.vertices, self.faces):
            digest.update(np.ascontiguousarray(array).data)
        for part in self.parts:
            digest.update(part.content())
        return digest.digest()


@dataclass
class Geometries(Resource):
    """The geometries of a world by number."""

    items: list[Geometry] = field(default_factory=list)
    numbers: dict[bytes, int] = field(default_factory=dict)

    def number(self, geometry: Geometry) -> int:
        """Return the number of this content, adding it when new."""
        found = self.numbers.setdefault(geometry.content(), len(self.items))
        if found == len(self.items):
            self.items.append(geometry)
        return found


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
    spread = np.linalg.svd(points - points.mean(axis=0), full_matrices=False, compute_uv=False)
    if spread[2] <= FLATTEST_HULL * spread[0]:  # qhull would joggle them into a hull
        raise flat
    try:
        hull = convex_hull(points)
    except (QhullError, ValueError):
        raise flat from None
    return Geometry(np.array(hull.vertices, np.float64), np.array(hull.faces, np.int64), source)
