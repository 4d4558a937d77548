"""Ball surface: triangles of a ball, stretched or not, for pictures large and small."""

from __future__ import annotations

import numpy as np

from carom.ecs.column import Floats
from carom.systems.shapes.shape import Surface

SUBDIVISIONS = (3, 2, 1)  # of an icosahedron: 1,280, 320 and 80 triangles


def ball_surfaces(radii: Floats) -> tuple[Surface, ...]:
    """Return surfaces of a ball with half axes (3,) in m, the finest first."""
    from trimesh.creation import icosphere

    surfaces = []
    for number in SUBDIVISIONS:
        ball = icosphere(subdivisions=number)
        middles = ball.vertices[ball.edges_unique].mean(axis=1)
        off = float((1.0 - np.linalg.norm(middles, axis=1).min()) * np.max(radii))
        surfaces.append(Surface(np.asarray(ball.vertices) * radii, np.asarray(ball.faces), True, off))
    return tuple(surfaces)
