"""Pairs with hulls in many poses at once, measured by the narrow phase's kernels and by coal."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from pairs import coal_geometry

from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion
from carom.systems.detection.hulls import pack
from carom.systems.detection.meshes import joined
from carom.systems.detection.narrow import STAND_INS
from carom.systems.kernels.crew import ALONE
from carom.systems.kernels.reduction import MOST_POINTS
from carom.systems.shapes import Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.orientation import Z_TO_Y
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.polyhedron import hull_faces
from carom.systems.shapes.sphere import Sphere

SIZE = 0.3  # m, about the smaller size of every shape but the wedge


def corners(x: float, y: float, z: float) -> Floats:
    """Return the corners of a box of these half edges."""
    return np.array([(i * x, j * y, k * z) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])


def rounded() -> Floats:
    """Return 20 points on an ellipsoid."""
    points = np.random.default_rng(3).normal(size=(20, 3))
    return points / np.sqrt((points**2).sum(axis=1))[:, None] * [0.4, 0.5, 0.6]


WEDGE = [(x, -0.3, z) for x in (-0.5, 0.5) for z in (-0.02, 0.02)] + [(-0.4, 0.3, 0.0), (0.4, 0.3, 0.0)]
HULLS = {
    "tetrahedron": hull_of(np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]) * 0.3, "tetrahedron"),
    "cube": hull_of(corners(0.15, 0.25, 0.4), "cube"),
    "rounded": hull_of(rounded(), "rounded"),
    "wedge": hull_of(np.array(WEDGE), "wedge"),
}
NUMBERS = {key: number for number, key in enumerate(HULLS)}
PACKED = pack({NUMBERS[key]: hull_faces(geometry) for key, geometry in HULLS.items()})
NO_MESHES = joined({})
SHAPES: dict[str, Shape] = {
    "sphere": Sphere(0.3),
    "capsule": Capsule(0.2, 0.7),
    "box": Box((0.3, 0.5, 0.8)),
    "plane": Plane((0.0, 3.0, 4.0), 1.0),
    **{key: Convex(geometry) for key, geometry in HULLS.items()},
}


class Placed(NamedTuple):
    """Poses of two shapes, (n, 3) and (n, 4)."""

    position_a: Floats
    rotation_a: Floats
    position_b: Floats
    rotation_b: Floats

    def swapped(self) -> Placed:
        """Return the poses with the second first."""
        return Placed(*self[2:], *self[:2])


class Measured(NamedTuple):
    """What a kernel found: points of pair k are ``count[k]`` rows from ``start[k]`` on."""

    start: Integers
    count: Integers
    feature: Integers
    normal: Floats
    depth: Floats
    point: Floats

    def deepest(self) -> Integers:
        """Return the row of each pair's deepest point; of pairs without points, any."""
        rows = self.start[:, None] + np.minimum(np.arange(MOST_POINTS), np.maximum(self.count[:, None] - 1, 0))
        return rows[np.arange(len(rows)), np.argmax(self.depth[rows], axis=1)]


def measure(a: str, b: str, placed: Placed, reach: float = 0.0) -> Measured:
    """Measure poses by the function that stands in for a pair in this order."""
    n = len(placed.position_a)
    room = MOST_POINTS * n
    found = Measured(
        np.zeros(n, np.int64), np.zeros(n, np.int64), np.zeros(room, np.int64),
        np.zeros((room, 3)), np.zeros(room), np.zeros((room, 3)),
    )  # fmt: skip
    STAND_INS[type(SHAPES[a]), type(SHAPES[b])](
        ALONE, np.arange(n), np.arange(n), np.arange(n, 2 * n), np.full(n, reach), 0, MOST_POINTS,
        np.repeat([SHAPES[a].number, SHAPES[b].number], n),
        np.repeat([SHAPES[a].packed(), SHAPES[b].packed()], n, axis=0),
        np.concatenate([placed.position_a, placed.position_b]),
        np.concatenate([placed.rotation_a, placed.rotation_b]),
        np.repeat([NUMBERS.get(a, -1), NUMBERS.get(b, -1)], n), PACKED, NO_MESHES, np.zeros(n), *found,
    )  # fmt: skip
    return found


def many_poses(a: str, b: str, count: int, seed: int) -> tuple[Placed, Floats, Floats]:
    """Return poses with coal's signed distances and normals: half within 1 % of touching, the rest within 5 %.

    A tenth have parallel axes and centres in line with one.
    """
    import coal

    generator = np.random.default_rng(seed)
    one, two = (quaternion.normalise(generator.normal(size=(count, 4))) for _ in range(2))
    towards = quaternion.rotate(one, generator.normal(size=(count, 3)))
    axes = generator.integers(3, size=len(towards[::10]))
    quarters = np.array([quaternion.from_axis_angle(axis, np.pi / 2) for axis in np.eye(3)])
    two[::10] = quaternion.multiply(one[::10], quarters[axes])
    towards[::10] = quaternion.rotate(one[::10], np.eye(3)[generator.integers(3, size=len(axes))])
    towards /= np.sqrt((towards**2).sum(axis=1))[:, None]
    target = SIZE * generator.uniform(-1.0, 1.0, count) * np.where(np.arange(count) % 2, 0.01, 0.05)
    turned = [
        quaternion.matrix(quaternion.multiply(turns, np.array(Z_TO_Y)) if SHAPES[key].along_z else turns)
        for key, turns in ((a, one), (b, two))
    ]
    first, second = (coal_geometry(SHAPES[key]) for key in (a, b))
    here, there = coal.Transform3s(), coal.Transform3s()
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    at, distances, normals = 3.0 * towards, np.empty(count), np.empty((count, 3))
    for k in range(count):
        here.setRotation(turned[0][k])
        there.setRotation(turned[1][k])
        for moved in (False, True):
            if moved:
                at[k] -= (distances[k] - target[k]) * normals[k]
            there.setTranslation(at[k])
            result.clear()
            distances[k] = coal.distance(first, here, second, there, request, result)
            normals[k] = result.normal
    return Placed(np.zeros((count, 3)), one, at, two), distances, normals


def extent(key: str, rotation: Floats, direction: Floats) -> Floats:
    """Return how far a shape about the origin reaches in each direction (n, 3)."""
    shape: Any = SHAPES[key]
    local = quaternion.rotate(quaternion.conjugate(rotation), direction)
    if key in HULLS:
        return (local[:, None] * HULLS[key].vertices).sum(axis=2).max(axis=1)
    bounds = shape.bounds()
    return np.abs(local * np.array(bounds.half)).sum(axis=1) + bounds.radius
