"""Surfaces: the triangles a shape declares, as a Rerun mesh."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.shapes import Shape
from carom.systems.shapes.shape import Surface

ENDLESS = 20.0  # an endless surface is drawn this many times as wide as its sample of 100 m: a shell flies that far


def mesh_of(shape: Shape, position: Floats, rotation: Floats, color: Floats) -> Any:
    """Return the mesh of a shape at its pose in the entity's frame, so that instances are posed by entities alone.

    Faces are seen from outside only: a room of planes stays open to a viewer who stands behind one of them. Every shape
    is a mesh, since Rerun's own capsule, posed in its entity's frame, shows only its first instance.
    """
    import rerun

    surface = shape.surface()
    if math.isinf(max(shape.bounds().half)):
        middle = surface.vertices.mean(axis=0)
        surface = surface._replace(vertices=middle + ENDLESS * (surface.vertices - middle))
    vertices, faces, normals = _with_normals(surface)
    return rerun.Mesh3D(
        vertex_positions=quaternion.rotate(rotation, vertices) + position,
        triangle_indices=faces,
        vertex_normals=quaternion.rotate(rotation, normals),
        albedo_factor=np.round(255.0 * np.clip(color, 0.0, 1.0)).astype(np.uint8),
        face_rendering="front",
    )


def _with_normals(surface: Surface) -> tuple[Floats, Any, Floats]:
    corners = surface.vertices[surface.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    if not surface.smooth:
        return corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3), _unit(np.repeat(normals, 3, axis=0))
    blended = np.zeros_like(surface.vertices)
    for corner in range(3):
        np.add.at(blended, surface.faces[:, corner], normals)
    return surface.vertices, surface.faces, _unit(blended)


def _unit(vectors: Floats) -> Floats:
    lengths = np.sqrt((vectors * vectors).sum(axis=1, keepdims=True))
    return vectors / np.where(lengths > 0.0, lengths, 1.0)
