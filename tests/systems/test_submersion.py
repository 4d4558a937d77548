"""What of shapes lies below a plane, against slices of fine meshes and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from carom.ecs.column import Floats
from carom.ecs.errors import DeclarationError
from carom.systems.shapes import SHAPES, Shape
from carom.systems.shapes.geometry import Geometry, hull_of
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.orientation import along_y

STAR = trimesh.creation.annulus(r_min=0.3, r_max=0.7, height=0.4)
RING = Geometry(np.array(STAR.vertices), np.array(STAR.faces, np.int64))
CORNERS = np.array([(0.5, 0.1, 0.0), (-0.6, 0.0, 0.1), (0.0, 0.7, 0.0), (0.1, -0.5, 0.2), (0.0, 0.1, 0.6), (0.2, 0.0, -0.5)])
VOLUMES = {
    "sphere": SHAPES["sphere"](radius=0.5),
    "ellipsoid": SHAPES["ellipsoid"](radii=(0.6, 0.2, 0.3)),
    "box": SHAPES["box"](size=(1.0, 0.6, 1.4)),
    "capsule": SHAPES["capsule"](radius=0.3, length=0.8),
    "cylinder": SHAPES["cylinder"](radius=0.4, length=1.0),
    "cone": SHAPES["cone"](radius=0.5, length=1.2),
    "convex": SHAPES["convex"](hull_of(CORNERS)),
    "mesh": Mesh(RING),
}


def fine(key: str, shape: Shape) -> trimesh.Trimesh:
    """Return a shape as many triangles."""
    if key in ("sphere", "ellipsoid"):
        ball = trimesh.creation.icosphere(subdivisions=5)
        return trimesh.Trimesh(ball.vertices * (shape.radius if key == "sphere" else shape.radii), ball.faces)
    if key == "capsule":
        mesh = trimesh.creation.capsule(height=shape.length, radius=shape.radius, count=[128, 128])
        return trimesh.Trimesh(along_y(mesh.vertices), mesh.faces)
    if key == "cylinder":
        mesh = trimesh.creation.cylinder(radius=shape.radius, height=shape.length, sections=256)
        return trimesh.Trimesh(along_y(mesh.vertices), mesh.faces)
    if key == "cone":
        mesh = trimesh.creation.cone(radius=shape.radius, height=shape.length, sections=256)
        return trimesh.Trimesh(along_y(mesh.vertices) - [0.0, shape.length / 2.0, 0.0], mesh.faces)
    surface = shape.surface()
    return trimesh.Trimesh(surface.vertices, surface.faces)


def submerged(shape: Shape, normal: Floats, depth: Floats) -> Floats:
    """Return the rows of one shape below many planes."""
    size = np.tile(np.array(shape.packed()), (len(depth), 1))
    return type(shape).submerged(size, getattr(shape, "geometry", None), normal, depth)


def sliced(mesh: trimesh.Trimesh, normal: Floats, depth: float) -> tuple[float, Floats]:
    """Return volume and centre of what trimesh cuts off; seen from the plane, the face it cuts open adds nothing."""
    origin = depth * normal
    vertices, faces, _ = trimesh.intersections.slice_faces_plane(mesh.vertices, mesh.faces, -normal, origin)
    corners = vertices[faces] - origin
    volumes = np.linalg.det(corners) / 6.0
    return float(volumes.sum()), origin + (volumes[:, None] * corners.sum(axis=1) / 4.0).sum(axis=0) / volumes.sum()


if __name__ == "__main__":
    rng = np.random.default_rng(1)
    for key, shape in VOLUMES.items():
        mesh = fine(key, shape)
        normal = rng.normal(size=(100, 3)); normal /= np.linalg.norm(normal, axis=1)[:, None]
        heights = mesh.vertices @ normal.T
        low, high = heights.min(axis=0), heights.max(axis=0)
        depth = low + (high - low) * rng.uniform(0.02, 0.98, 100)
        import time
        submerged(shape, normal, depth)
        t=time.perf_counter(); found = submerged(shape, normal, depth); t=time.perf_counter()-t
        worst = np.zeros(3)
        for row, n, d in zip(found, normal, depth):
            v, c = sliced(mesh, n, d)
            worst = np.maximum(worst, [abs(row[0]/v-1), np.linalg.norm(row[1:4]-c)/mesh.scale, abs(row[4]/shape.mass_properties().volume-1)])
        print(key, worst, f"{t*1e4:.2f} us each")
