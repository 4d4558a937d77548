"""Bodies and poses that tests of the renderer draw."""

from __future__ import annotations

import numpy as np
from trimesh.creation import box

from carom.tools.batch import Batch

CUBE = box(extents=(1.0, 1.0, 1.0))
WHITE = (1.0, 1.0, 1.0, 1.0)


def poses(*positions: tuple[float, float, float]) -> np.ndarray:
    """Return unturned poses (n, 4, 4)."""
    made = np.tile(np.eye(4), (len(positions), 1, 1))
    made[:, :3, 3] = np.reshape(positions, (-1, 3))
    return made


def batch(
    mesh: object,
    *positions: tuple[float, float, float],
    color: tuple[float, ...] = WHITE,
    first: int = 0,
    smooth: bool = False,
) -> Batch:
    """Return copies of a trimesh in one colour, numbered from ``first``."""
    ids = np.arange(first, first + len(positions))
    return Batch(mesh.vertices, mesh.faces, poses(*positions), np.tile(color, (len(positions), 1)), ids, smooth)  # type: ignore[attr-defined]
