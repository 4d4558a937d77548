"""Wireframe: the edges of everything that is visible."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.tools.batch import Batch
from carom.tools.marks import Lines, Mark
from carom.tools.overlays.overlay import Overlay, Seen
from carom.tools.view import View

DARKER = 0.45  # than the body
FLAT = 1.0 - 1e-6  # cosine between faces beyond which what they share is no edge of the body
APART = 6.0  # px: edges that are closer are paler, so that fine meshes let through what is behind


class Wireframe(Overlay):
    """Lines where two faces meet at an angle, hidden behind bodies; without bodies to hide them all are seen."""

    key: ClassVar[str] = "wireframe"

    def __init__(self) -> None:
        self._edges: dict[int, tuple[Integers, float, Floats]] = {}

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return the edges of all copies of each mesh; endless floors have none."""
        return [self._lines(batch, seen.view) for batch in seen.batches if batch.floor is None]

    def _lines(self, batch: Batch, view: View) -> Lines:
        edges, surface = self._edges_of(batch)
        turn, shift = batch.poses[:, None, :3, :3], batch.poses[:, None, :3, 3]
        starts, ends = (
            ((turn @ batch.vertices[edges[:, end], :, None])[..., 0] + shift).reshape(-1, 3) for end in (0, 1)
        )
        length = np.sqrt(((ends - starts) ** 2).sum(axis=1)).reshape(len(batch.poses), -1).sum(axis=1)  # m
        one, other = view.segments(starts, ends)
        drawn = np.nan_to_num(np.hypot(*(other - one)[:, :2].T)).reshape(len(batch.poses), -1).sum(axis=1)  # px
        apart = surface / length * (drawn / length)
        colors = batch.colors * (DARKER, DARKER, DARKER, 1.0)
        colors[:, 3] *= np.minimum(apart / APART, 1.0)
        return Lines(starts, ends, np.repeat(colors, len(edges), axis=0), 1.0, behind=0.0)

    def _edges_of(self, batch: Batch) -> tuple[Integers, float]:
        """Return the edges and the area (m2) of a mesh, found once."""
        key = id(batch.vertices)
        if key not in self._edges:
            vertices, faces = batch.vertices, batch.faces
            self._edges[key] = edges_of(vertices, faces), area(vertices, faces), vertices
        return self._edges[key][:2]  # with the vertices lives their array, so that no other gets its id


def area(vertices: Floats, faces: Integers) -> float:
    """Return the area (m2) of a mesh."""
    corners = vertices[faces]
    crossed = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(0.5 * np.sqrt((crossed * crossed).sum(axis=1)).sum())


def edges_of(vertices: Floats, faces: Integers) -> Integers:
    """Return the edges (e, 2) of a mesh, each once, but for those between two faces of one plane."""
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    _, place = np.unique(vertices, axis=0, return_inverse=True)  # vertices that lie in one place are one
    place = place.ravel()
    sides = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    _, first, which, count = np.unique(
        np.sort(place[sides], axis=1), axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    total = np.stack([np.bincount(which.ravel(), np.repeat(normals[:, k], 3), len(first)) for k in range(3)], axis=1)
    flat = (count == 2) & ((total * total).sum(axis=1) > 2.0 + 2.0 * FLAT)
    return np.asarray(sides[first[~flat]])
