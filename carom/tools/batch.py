"""Batches: what a renderer draws, as plain arrays. One batch is one mesh drawn many times."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats, Integers
from carom.ecs.errors import CaromError
from carom.systems.shapes.finish import Finish
from carom.systems.shapes.shape import Surface

LARGEST_ID = 2**24 - 2  # an id goes through the three colour channels, and 0 means background
CREASE = math.cos(math.radians(30.0))  # faces that meet at a flatter angle are shaded as one curved surface


@dataclass(frozen=True, eq=False)
class Batch:
    """``n`` copies of a mesh.

    ``vertices`` (v, 3) in m in the mesh's own frame and ``faces`` (f, 3), counter-clockwise seen from outside; hand in
    the same two array objects again and they stay on the graphics side. ``poses`` (n, 4, 4) are ``world_from_mesh``,
    ``colors`` (n, 4) red green blue alpha in 0..1 as on a screen, ``ids`` (n,) from 0 to 2^24 - 2. ``smooth`` blends
    normals over every edge, not only the blunt ones. ``floor`` (v, 2) gives each vertex coordinates in m for a pattern
    of squares, and makes the surface fade into the distance. ``coarser`` are meshes of the same shape for copies that
    are small in the picture.
    """

    vertices: Floats
    faces: Integers
    poses: Floats
    colors: Floats
    ids: Integers
    smooth: bool = False
    floor: Floats | None = None
    finish: Finish | None = None
    coarser: tuple[Surface, ...] = ()

    def __post_init__(self) -> None:
        """Refuse columns of different lengths and ids that do not fit; raise CaromError."""
        if not len(self.poses) == len(self.colors) == len(self.ids):
            lengths = f"{len(self.poses)}, {len(self.colors)} and {len(self.ids)}"
            raise CaromError(f"batch: poses, colors and ids must be as many, received {lengths}")
        if len(self.ids) and not 0 <= self.ids.min() <= self.ids.max() <= LARGEST_ID:
            received = f"{self.ids.min()} to {self.ids.max()}"
            raise CaromError(f"batch: ids must lie from 0 to {LARGEST_ID}, received {received}")

    def take(self, copies: Integers) -> Batch:
        """Return some of the copies, by their numbers."""
        return replace(self, poses=self.poses[copies], colors=self.colors[copies], ids=self.ids[copies])


class Shading(NamedTuple):
    """Vertices as OpenGL wants them: one normal for each; ``source`` (w,) is the vertex each was made from."""

    positions: Floats
    normals: Floats
    indices: Integers
    source: Integers


def shading(vertices: Floats, faces: Integers, smooth: bool = False) -> Shading:
    """Return the mesh with unit normals: blended over blunt edges (over all if ``smooth``), split along sharp ones.

    Each corner of a face takes the sum of the normals, weighted by area, of those faces around its vertex that lean
    less than 30 degrees against its own.
    """
    corners = np.asarray(vertices, np.float64)[faces]
    weighted = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit = weighted / np.maximum(np.linalg.norm(weighted, axis=1), 1e-300)[:, None]
    vertex = np.asarray(faces).ravel()
    face = np.repeat(np.arange(len(faces)), 3)
    order = np.argsort(vertex, kind="stable")
    count = np.bincount(vertex, minlength=len(vertices))
    first = np.cumsum(count) - count
    repeats = count[vertex]
    here = np.repeat(np.arange(len(vertex)), repeats)
    step = np.arange(len(here)) - np.repeat(np.cumsum(repeats) - repeats, repeats)
    there = order[first[vertex[here]] + step]
    if not smooth:
        alike = np.einsum("ij,ij->i", unit[face[here]], unit[face[there]]) > CREASE
        here, there = here[alike], there[alike]
    summed = np.stack([np.bincount(here, weighted[face[there], axis], len(vertex)) for axis in range(3)], axis=1)
    normals = summed / np.maximum(np.linalg.norm(summed, axis=1), 1e-300)[:, None]
    keys: npt.NDArray[np.float64] = np.column_stack([vertex, np.round(normals, 6)])
    _, keep, indices = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    return Shading(np.asarray(vertices)[vertex[keep]], normals[keep], indices.reshape(-1, 3), vertex[keep])
