"""Thousands of poses of two shapes at once, as the kernels of the narrow phase take them, with coal's opinion."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from pairs import Coal

from carom.ecs.column import Floats, Integers
from carom.ecs.components.collider import SHAPE_PARAMETERS
from carom.ecs.spatial import quaternion
from carom.systems.detection.hulls import pack
from carom.systems.detection.meshes import joined
from carom.systems.detection.narrow import STAND_INS
from carom.systems.kernels.crew import ALONE
from carom.systems.kernels.reduction import MOST_POINTS
from carom.systems.shapes import Shape
from carom.systems.shapes.orientation import Z_TO_Y
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.point import Point

FAR = 4.0  # m, where shapes of about 1 m are well apart
TURNS = [quaternion.IDENTITY] + [
    quaternion.from_axis_angle(axis, angle) for axis in np.eye(3) for angle in (np.pi / 4, np.pi / 2)
]


class Batch(NamedTuple):
    """Poses of two shapes: the first at the origin."""

    rotation_a: Floats
    position_b: Floats
    rotation_b: Floats


class Answer(NamedTuple):
    """Points of all poses one after the other: pose p has ``count[p]`` from ``start[p]`` on."""

    start: Integers
    count: Integers
    feature: Integers
    normal: Floats
    depth: Floats
    point: Floats

    def deepest(self) -> tuple[Floats, Floats]:
        """Return depth and normal of the deepest point of every pose; minus infinity where there is none."""
        pose = np.repeat(np.arange(len(self.count)), self.count)
        order = np.lexsort((-self.depth, pose))
        _, first = np.unique(pose[order], return_index=True)
        depth, normal = np.full(len(self.count), -np.inf), np.zeros((len(self.count), 3))
        depth[self.count > 0], normal[self.count > 0] = self.depth[order][first], self.normal[order][first]
        return depth, normal


def measure_batch(
    a: Shape, b: Shape, batch: Batch, reach: float, origin: Any = 0.0, *, swapped: bool = False
) -> Answer:
    """Return what the table's kernel says; ``swapped`` hands it the second shape first."""
    n = len(batch.position_b)
    size = np.zeros((2 * n, SHAPE_PARAMETERS))
    size[:n], size[n:] = a.packed(), b.packed()
    position = np.concatenate([np.zeros((n, 3)), batch.position_b]) + origin
    rotation = np.concatenate([batch.rotation_a, batch.rotation_b])
    start, count = np.zeros(n, np.int64), np.zeros(n, np.int64)
    feature, normal, depth, point = (
        np.zeros(MOST_POINTS * n, np.int64),
        np.zeros((MOST_POINTS * n, 3)),
        np.zeros(MOST_POINTS * n),
        np.zeros((MOST_POINTS * n, 3)),
    )
    rows = np.arange(n), np.arange(n, 2 * n)
    STAND_INS[type(a), type(b)](
        ALONE, np.arange(n), rows[swapped], rows[not swapped], np.full(n, reach), 0, MOST_POINTS,
        np.repeat([a.number, b.number], n), size, position, rotation, np.full(2 * n, -1), pack({}), joined({}),
        np.zeros(n), start, count, feature, normal, depth, point,
    )  # fmt: skip
    taken = count.sum()
    return Answer(start, count, feature[:taken], normal[:taken], depth[:taken], point[:taken])


def random_batch(a: Shape, b: Shape, count: int, seed: int) -> tuple[Batch, Floats, Floats]:
    """Return poses with coal's signed distance and normal: from a gap of a tenth to an overlap of 5 % of the smaller.

    More than half are within 1 % of touching; a tenth have both shapes turned by multiples of 45 degrees about an axis,
    and most of these lie along an axis from one another, so that faces, edges and vertices are aligned.
    """
    generator = np.random.default_rng(seed)
    aligned = np.arange(count) % 10 == 0
    turned = [quaternion.normalise(generator.normal(size=(count, 4))) for _ in (a, b)]
    towards = generator.normal(size=(count, 3))
    for rotation in turned:
        rotation[aligned] = np.array(TURNS)[generator.integers(len(TURNS), size=aligned.sum())]
    along = aligned & (generator.random(count) < 0.7)
    towards[along] = np.eye(3)[generator.integers(3, size=along.sum())]
    towards /= np.sqrt((towards**2).sum(axis=1))[:, np.newaxis]
    for sense, shape, rotation in ((1.0, a, turned[0]), (-1.0, b, turned[1])):
        if isinstance(shape, Plane):
            towards = sense * quaternion.rotate(rotation, np.array(shape.normal))
    size = smaller(a, b)
    near = generator.random(count) < 0.7
    depth = size * np.where(near, generator.uniform(-0.01, 0.01, count), generator.uniform(-0.1, 0.05, count))
    coal = Coal(a, b)
    matrices = [
        quaternion.matrix(quaternion.multiply(rotation, np.array(Z_TO_Y)) if shape.along_z else rotation)
        for shape, rotation in zip((a, b), turned, strict=True)
    ]
    position, distance, normal = FAR * towards, np.zeros(count), np.zeros((count, 3))
    for p in range(count):
        for _ in range(3):  # moving along the normal is exact where shapes overlap, and leaves a gap where not
            position[p] -= normal[p] * (distance[p] + depth[p])
            distance[p], normal[p] = coal.distance(matrices[0][p], matrices[1][p], position[p])
    return Batch(turned[0], position, turned[1]), distance, normal


def smaller(a: Shape, b: Shape) -> float:
    """Return the least width of the smaller shape."""
    return min(shape.bounds().width for shape in (a, b) if not isinstance(shape, Point | Plane))


def separation(a: Shape, b: Shape, batch: Batch, normal: Floats) -> Floats:
    """Return how far apart boxes and round shapes are along unit vectors from a to b, by their support functions."""
    return (
        (normal * batch.position_b).sum(axis=1)
        - extent(a, batch.rotation_a, normal)
        - extent(b, batch.rotation_b, normal)
    )


def extent(shape: Shape, rotation: Floats, normal: Floats) -> Floats:
    """Return how far centred shapes reach along unit vectors."""
    bounds = shape.bounds()
    local = quaternion.rotate(quaternion.conjugate(rotation), normal)
    reached: Floats = (np.abs(local) * np.array(bounds.half)).sum(axis=1) + bounds.radius
    return reached
