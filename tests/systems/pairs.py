"""Pairs of shapes in poses of choice, as the narrow phase sees them, and coal as a second opinion."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import trimesh

from carom.ecs import ColliderPose
from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.detection.fcl_pairs import measure_by_fcl
from carom.systems.detection.narrow import Points as Room
from carom.systems.kernels.reduction import MOST_POINTS
from carom.systems.shapes import Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.geometry import Geometry, hull_of
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.orientation import Z_TO_Y
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.point import Point
from carom.systems.shapes.sphere import Sphere
from carom.systems.simulation import Simulation

STAND_IN = 0.1  # m, radius of the ball that stands for a point: the distance to its surface is less by just that
Points = list[tuple[Floats, Floats, float]]


def degrees_between(a: Any, b: Any) -> Any:
    """Return the angles of unit vectors (..., 3)."""
    return np.degrees(2.0 * np.arcsin(np.minimum(1.0, 0.5 * np.sqrt((np.subtract(a, b) ** 2).sum(axis=-1)))))


class Poses(NamedTuple):
    """Where two shapes are."""

    position_a: Floats
    rotation_a: Floats
    position_b: Floats
    rotation_b: Floats


def hull() -> Geometry:
    """Return a hull of 24 points on an ellipsoid."""
    points = quaternion.normalise(np.random.default_rng(0).normal(size=(24, 3)))
    return hull_of(points * [0.4, 0.5, 0.6])


def block() -> Geometry:
    """Return a box made of triangles."""
    mesh = trimesh.creation.box(extents=(0.6, 0.8, 1.0))
    return Geometry(np.array(mesh.vertices), np.array(mesh.faces, np.int64), "block")


SHAPES: dict[str, Shape] = {
    "sphere": Sphere(0.7),
    "point": Point(),
    "box": Box((0.3, 0.5, 0.8)),
    "capsule": Capsule(0.4, 1.1),
    "cylinder": Cylinder(0.4, 1.1),
    "convex": Convex(hull()),
    "mesh": Mesh(block()),
    "plane": Plane((0.0, 3.0, 4.0), 1.0),
}
PAIRS = [(a, b) for a in SHAPES for b in SHAPES if not (SHAPES[a].static and SHAPES[b].static)]


class Pair:
    """Two shapes in a world of their own, placed and measured at will."""

    def __init__(self, a: Shape, b: Shape) -> None:
        simulation = Simulation()
        for shape in (a, b):
            body = None if shape.static else {"mass": 1.0}
            simulation.add(collider={"shape": shape}, body=body, visual=False)
        self.world = simulation.world

    def measure(self, poses: Poses, reach: float = 0.0, *, swapped: bool = False) -> Points:
        """Return FCL's guarded answer, from the first to the second or the other way round."""
        with self.world.edit(ColliderPose) as pose:
            pose.position[0], pose.rotation[0] = poses.position_a, poses.rotation_a
            pose.position[1], pose.rotation[1] = poses.position_b, poses.rotation_b
        points = Room(1, MOST_POINTS)
        pairs = np.array([[1, 0]] if swapped else [[0, 1]])
        with self.world.faces(None):
            taken = measure_by_fcl(self.world, np.arange(1), pairs, np.array([reach]), points)
        found = zip(points.point[:taken], points.normal[:taken], points.depth[:taken].tolist(), strict=True)
        self.features = points.feature[:taken].tolist()
        return list(found)


def turns(generator: np.random.Generator) -> Floats:
    """Draw a random rotation."""
    return quaternion.normalise(generator.normal(size=4))


class Coal:
    """Coal's signed distance of two shapes."""

    def __init__(self, a: Shape, b: Shape) -> None:
        self.shapes = (a, b)
        self.geometries = (coal_geometry(a), coal_geometry(b))

    def distance(self, turned_a: Floats, turned_b: Floats, apart: Floats) -> tuple[float, Floats]:
        """Return the signed distance (m) and the normal from a, at the origin, to b; rotations are matrices."""
        import coal

        a, b = self.geometries
        result = coal.DistanceResult()
        here, there = coal.Transform3s(turned_a, np.zeros(3)), coal.Transform3s(turned_b, apart)
        distance = coal.distance(a, here, b, there, coal.DistanceRequest(), result)
        points = sum(isinstance(shape, Point) for shape in self.shapes)
        return float(distance) + STAND_IN * points, np.array(result.normal)

    def overlapping(
        self, depth: float, rotation_a: Floats, rotation_b: Floats, towards: Floats
    ) -> tuple[Poses, Floats]:
        """Return poses that overlap by ``depth``, b lying ``towards`` from a, and the normal."""
        matrices = [
            quaternion.matrix(quaternion.multiply(rotation, Z_TO_Y) if shape.along_z else rotation)
            for shape, rotation in zip(self.shapes, (rotation_a, rotation_b), strict=True)
        ]
        near, far = 0.0, 4.0
        while far - near > 1e-11:
            middle = 0.5 * (near + far)
            if self.distance(*matrices, middle * towards)[0] > -depth:
                far = middle
            else:
                near = middle
        normal = self.distance(*matrices, middle * towards)[1]
        return Poses(np.zeros(3), rotation_a, middle * towards, rotation_b), normal


def coal_geometry(shape: Any) -> Any:
    """Return coal's geometry of a shape; a mesh becomes convex, which those used here are."""
    import coal

    if isinstance(shape, Convex | Mesh):
        points, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
        for vertex in shape.geometry.vertices:
            points.append(np.array(vertex))
        for face in shape.geometry.faces.tolist():
            triangles.append(coal.Triangle(*face))
        return coal.Convex(points, triangles)
    makers: dict[str, Any] = {
        "sphere": lambda: coal.Sphere(shape.radius),
        "point": lambda: coal.Sphere(STAND_IN),
        "box": lambda: coal.Box(*shape.size),
        "capsule": lambda: coal.Capsule(shape.radius, shape.length),
        "cylinder": lambda: coal.Cylinder(shape.radius, shape.length),
        "cone": lambda: coal.Cone(shape.radius, shape.length),
        "ellipsoid": lambda: coal.Ellipsoid(*shape.radii),
        "plane": lambda: coal.Halfspace(np.array(shape.normal), shape.offset),
    }
    return makers[shape.key]()


def shallow_poses(a: Shape, b: Shape, count: int, seed: int) -> Iterator[tuple[Poses, float, Floats]]:
    """Yield random poses that overlap by 1 mm and 1 cm in turn, a fifth of them with parallel axes."""
    generator = np.random.default_rng(seed)
    coal = Coal(a, b)
    quarters = [quaternion.IDENTITY, *(quaternion.from_axis_angle(axis, np.pi / 2) for axis in np.eye(3))]
    for k in range(count):
        if k % 5:
            first, second = turns(generator), turns(generator)
            towards = generator.normal(size=3)
            towards /= np.linalg.norm(towards)
        else:
            first, second = quarters[generator.integers(4)], quarters[generator.integers(4)]
            towards = np.eye(3)[generator.integers(3)]
        for side, shape, rotation in ((1.0, a, first), (-1.0, b, second)):
            if isinstance(shape, Plane):
                towards = side * quaternion.rotate(rotation, shape.normal)
        depth = (1e-3, 1e-2)[k % 2]
        poses, normal = coal.overlapping(depth, first, second, towards)
        yield poses, depth, normal
