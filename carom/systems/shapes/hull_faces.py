"""Hull faces: the triangles of a hull as they are stated, since planes of more corners can be cut in many ways."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from carom.ecs.errors import DeclarationError
from carom.systems.constants import FACE_FLAT
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.welding import seams


def with_faces(hull: Geometry, faces: npt.ArrayLike) -> Geometry:
    """Return a hull with these triangles (f, 3) in the place of its own; raise DeclarationError where they are none.

    They close a surface over all of its vertices, and nothing lies in front of any of them.
    """
    stated, count = np.asarray(faces, np.int64).reshape(-1, 3), len(hull.vertices)
    complete = np.array_equal(np.unique(stated), np.arange(count))
    if not complete or any(seams(stated, count)) or _farthest_in_front(hull, stated) > FACE_FLAT * _width(hull):
        fault = "must be triangles that close the hull, each turned outward"
        raise DeclarationError(f"{hull.source}: faces {fault}; leave them out to have them found")
    return Geometry(hull.vertices, stated, hull.source)


def _farthest_in_front(hull: Geometry, faces: npt.NDArray[np.int64]) -> float:
    """Return how far (m) any vertex lies in front of any face."""
    farthest = 0.0
    for a, b, c in hull.vertices[faces]:
        normal = np.cross(b - a, c - a)
        length = float(np.linalg.norm(normal))
        if length > 0.0:
            farthest = max(farthest, float(((hull.vertices - a) @ normal).max()) / length)
    return farthest


def _width(hull: Geometry) -> float:
    return float(np.ptp(hull.vertices, axis=0).max())
