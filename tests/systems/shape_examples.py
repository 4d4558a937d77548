"""One of each shape, for tests of shapes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import trimesh

from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.geometry import Geometry, hull_of
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.orientation import along_y
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.point import Point
from carom.systems.shapes.sphere import Sphere

TETRAHEDRON = np.array([[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.2, 0.8, 0.1], [0.1, 0.3, 1.5]])


def ring() -> Geometry:
    """Return a sheared ring beside the origin: hollow, and its principal axes are not the coordinate axes."""
    mesh = trimesh.creation.annulus(r_min=0.3, r_max=0.7, height=0.4)
    shear = np.array([[1.0, 0.4, 0.0], [0.0, 1.0, 0.3], [0.0, 0.0, 1.0]])
    return Geometry(mesh.vertices @ shear + [0.5, 0.0, 0.1], np.array(mesh.faces, np.int64), "ring")


HILLS = [[0.0, 0.4, 0.1], [0.3, 1.0, -0.2], [0.2, 0.0, 0.5], [0.1, 0.1, 0.1]]
EXAMPLES: dict[str, Callable[[], Any]] = {
    "sphere": lambda: Sphere(0.7),
    "box": lambda: Box((0.3, 0.5, 0.8)),
    "plane": lambda: Plane((0.0, 3.0, 4.0), -0.5),
    "point": lambda: Point(),
    "capsule": lambda: Capsule(0.4, 1.1),
    "cylinder": lambda: Cylinder(0.4, 1.1),
    "cone": lambda: Cone(0.4, 1.1),
    "ellipsoid": lambda: Ellipsoid((0.3, 0.7, 0.5)),
    "convex": lambda: Convex(hull_of(TETRAHEDRON)),
    "mesh": lambda: Mesh(ring()),
    "height_field": lambda: HeightField.stated(heights=HILLS, spacing=[0.5, 0.8]),
}
ENDLESS = ("plane", "height_field")  # no volume, since there is no end to it
SOLID = [key for key in EXAMPLES if key not in (*ENDLESS, "point")]
ROUND = ("sphere", "capsule", "cylinder", "cone", "ellipsoid")


def fine(key: str, shape: Any, *, subdivisions: int = 6, sections: int = 400) -> trimesh.Trimesh:
    """Return a solid's surface as so many triangles that it is right to 3e-4 of its size, or as fewer."""
    if key in ("sphere", "ellipsoid"):
        ball = trimesh.creation.icosphere(subdivisions=subdivisions)
        return trimesh.Trimesh(ball.vertices * (shape.radius if key == "sphere" else shape.radii), ball.faces)
    if key == "capsule":
        mesh = trimesh.creation.capsule(height=shape.length, radius=shape.radius, count=[sections, sections])
        return trimesh.Trimesh(along_y(mesh.vertices), mesh.faces)
    if key == "cylinder":
        mesh = trimesh.creation.cylinder(radius=shape.radius, height=shape.length, sections=sections)
        return trimesh.Trimesh(along_y(mesh.vertices), mesh.faces)
    if key == "cone":  # trimesh's stands on its base
        mesh = trimesh.creation.cone(radius=shape.radius, height=shape.length, sections=sections)
        return trimesh.Trimesh(along_y(mesh.vertices) - [0.0, shape.length / 2.0, 0.0], mesh.faces)
    surface = shape.surface()
    return trimesh.Trimesh(surface.vertices, surface.faces)
