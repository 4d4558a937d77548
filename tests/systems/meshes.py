"""Meshes to lay bodies on, and brute force to hold the narrow phase to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from carom.ecs import ColliderPose
from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.detection.narrow import Found, measure_pairs
from carom.systems.shapes import Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.orientation import Z_TO_Y
from carom.systems.shapes.sphere import Sphere
from carom.systems.simulation import Simulation

LEVEL = np.array(quaternion.IDENTITY)
LYING = quaternion.from_axis_angle((1.0, 0.0, 0.0), np.pi / 2)  # along z
Resting = dict[str, tuple[Shape, Floats, float]]  # shapes with the turn in which they rest, and their height then
SOLIDS: Resting = {
    "box": (Box((1.0, 1.0, 1.0)), LEVEL, 0.5),
    "sphere": (Sphere(0.5), LEVEL, 0.5),
    "capsule": (Capsule(0.3, 0.8), LYING, 0.3),
}
ROUNDS: Resting = {
    "standing cylinder": (Cylinder(0.3, 0.8), LEVEL, 0.4),
    "lying cylinder": (Cylinder(0.3, 0.8), LYING, 0.3),
    "cone": (Cone(0.3, 0.8), LEVEL, 0.4),
    "ellipsoid": (Ellipsoid((0.3, 0.2, 0.4)), LEVEL, 0.2),
}


def sheet(cells: int, width: float, rough: float, shift: float = 0.0, seed: int = 0) -> Geometry:
    """Return land of ``cells`` x ``cells`` squares, of random heights up to ``rough`` (m), inner ones moved about."""
    generator = np.random.default_rng(seed)
    steps = np.linspace(-width / 2.0, width / 2.0, cells + 1)
    x, z = np.meshgrid(steps, steps, indexing="ij")
    inner = (np.abs(x) < width / 2.0 - 1e-9) & (np.abs(z) < width / 2.0 - 1e-9)
    x, z = (c + inner * shift * width / cells * generator.uniform(-1.0, 1.0, c.shape) for c in (x, z))
    vertices = np.stack([x, rough * generator.uniform(size=x.shape), z], axis=-1).reshape(-1, 3)
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    across = corner + cells + 2
    faces = np.concatenate([np.stack([corner, corner + 1, across], 1), np.stack([corner, across, across - 1], 1)])
    return Geometry(vertices, faces, "sheet")


def block() -> Geometry:
    """Return a box of 4 x 2 x 4 m as twelve triangles, its top at height 0."""
    import trimesh

    mesh = trimesh.creation.box(extents=(4.0, 2.0, 4.0))
    return Geometry(np.array(mesh.vertices) - [0.0, 1.0, 0.0], np.array(mesh.faces, np.int64), "block")


def nearest(geometry: Geometry, places: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the distance of each place (n, 3) to all triangles, the nearest place and its normal, by brute force.

    Of several triangles at that place the one that faces it most tells the normal.
    """
    best, at, facing = np.full(len(places), 1e6), np.zeros_like(places), np.zeros_like(places)
    for face in geometry.faces:
        corners = geometry.vertices[face]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        normal /= np.linalg.norm(normal)
        over = places - ((places - corners[0]) @ normal)[:, None] * normal
        inside = np.ones(len(places), bool)
        parts = []
        for k in range(3):
            start, along = corners[k], corners[(k + 1) % 3] - corners[k]
            inside &= np.cross(along, over - start) @ normal >= 0.0
            share = np.clip((places - start) @ along / (along @ along), 0.0, 1.0)
            parts.append(start + share[:, None] * along)
        parts.append(np.where(inside[:, None], over, 1e9))
        for part in parts:
            distance = np.sqrt(((places - part) ** 2).sum(axis=1))
            faces_more = np.abs((places - part) @ normal) > np.abs(((places - at) * facing).sum(axis=1))
            nearer = (distance < best - 1e-12) | ((distance < best + 1e-12) & faces_more)
            best[nearer], at[nearer], facing[nearer] = distance[nearer], part[nearer], normal
    return best, at, facing


class Laid(NamedTuple):
    """A mesh and copies of a shape in a world, the mesh's row ``row``, the bodies' ``first`` and on."""

    simulation: Simulation
    row: int
    first: int

    def measure(self, places: Floats, turns: Floats, reach: float) -> list[Found]:
        """Return the points of each body in its pose, given in the frame of the mesh."""
        world = self.simulation.world
        rows = self.first + np.arange(len(places))
        with world.edit(ColliderPose) as pose:
            there, turn = pose.position[self.row].copy(), pose.rotation[self.row].copy()
            pose.position[rows] = there + quaternion.rotate(turn, places)
            pose.rotation[rows] = quaternion.multiply(turn, turns)
        pairs = np.sort(np.stack([np.full(len(rows), self.row), rows], axis=1), axis=1)
        found = measure_pairs(world, pairs, np.full(len(rows), reach))
        assert not found.by_fcl.any()
        other = np.where(found.row_a == self.row, found.row_b, found.row_a)
        return [found.take(other == row) for row in rows]


def laid(geometry: Geometry, shape: Shape, count: int, *, mesh_first: bool = True, turn: Any = None) -> Laid:
    """Return a world of one mesh, moved and turned unless ``turn`` says how, and bodies of a shape."""
    simulation = Simulation()
    turned = quaternion.normalise(np.array([0.1, 0.7, -0.3, 0.6])) if turn is None else turn
    there = (3.0, -2.0, 1.0) if turn is None else (0.0, 0.0, 0.0)
    mesh: dict[str, Any] = {
        "collider": {"shape": Mesh(geometry)},
        "transform": {"position": there, "rotation": turned},
        "visual": False,
    }
    if mesh_first:
        simulation.add(**mesh)
    for _ in range(count):
        simulation.add(collider={"shape": shape}, body={"mass": 1.0}, visual=False)
    if not mesh_first:
        simulation.add(**mesh)
    row = 0 if mesh_first else count
    with simulation.world.edit(ColliderPose) as pose:
        pose.position[row], pose.rotation[row] = there, turned
    return Laid(simulation, row, int(mesh_first))


class Coal:
    """Coal's distance of a shape to a mesh; test-only."""

    def __init__(self, geometry: Geometry, shape: Any, along_z: bool) -> None:
        import coal

        places, faces = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
        for vertex in geometry.vertices:
            places.append(np.array(vertex))
        for face in geometry.faces.tolist():
            faces.append(coal.Triangle(*face))
        self.mesh = coal.BVHModelOBBRSS()
        self.mesh.beginModel(len(faces), len(places))
        self.mesh.addSubModel(places, faces)
        self.mesh.endModel()
        self.shape, self.along_z = shape, along_z

    def distance(self, place: Sequence[float], turn: Floats) -> float:
        """Return the distance, 0 or less where they meet."""
        import coal

        matrix = quaternion.matrix(quaternion.multiply(turn, Z_TO_Y) if self.along_z else turn)
        placed = coal.Transform3s(matrix, np.array(place))
        request, result = coal.DistanceRequest(), coal.DistanceResult()
        return float(coal.distance(self.shape, placed, self.mesh, coal.Transform3s(), request, result))
