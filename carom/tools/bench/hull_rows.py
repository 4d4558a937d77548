"""Hulls: their array kernels against `fcl.collide` on the same touching poses, in alternation on one thread."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from statistics import median
from typing import Any

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.components.collider import SHAPE_PARAMETERS
from carom.ecs.spatial import quaternion
from carom.systems.detection.hulls import pack
from carom.systems.detection.narrow import MOST_POINTS, STAND_INS
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.orientation import Z_TO_Y, wxyz_from_xyzw
from carom.systems.shapes.polyhedron import hull_faces
from carom.systems.shapes.shape import Shape
from carom.tools.bench.measure import Figure, timed

POSES = 10_000
DRAWN = 50 * POSES  # of which those that touch are kept
DEEPEST = 0.05  # m
REPEATS = 5
CALLS = 5  # of the kernel in a repeat
VERTICES = 20

Points = tuple[Any, ...]


def figures() -> Iterator[Figure]:
    """Yield how many times faster each kernel is; FCL's call counts alone, with its result, not what reads it.

    FCL gives one point, and a normal up to 30 degrees off; the kernels up to four and the least overlap there is.
    """
    round_points = quaternion.normalise(np.random.default_rng(3).normal(size=(VERTICES, 4)))[:, :3]
    hull = Convex(hull_of(round_points * [0.4, 0.5, 0.6]))
    pairs = {
        "hull-hull": (hull, hull, 1.0),
        "box-hull": (Box((0.3, 0.5, 0.8)), hull, 1.3),
        "capsule-hull": (Capsule(0.2, 0.7), hull, 3.0),
    }
    for name, (a, b, bound) in pairs.items():
        position, rotation = touching(a, b)
        by_kernel, by_fcl = kernel_call(a, b, position, rotation)[0], fcl_call(a, b, position, rotation)
        ratios = []
        for _ in range(REPEATS):
            theirs, ours = timed(by_fcl, 1), timed(by_kernel, CALLS)
            ratios.append((theirs.wall / ours.wall, theirs.cpu / ours.cpu))
        wall, cpu = (median(column) for column in zip(*ratios, strict=True))
        label = f"{name} of {VERTICES} vertices, touching"
        yield Figure(label, "x faster than FCL", wall, cpu, bound, "cpu", True, REPEATS)


def touching(a: Shape, b: Shape) -> tuple[Floats, Floats]:
    """Draw random poses that overlap by at most DEEPEST: positions (2, n, 3) and rotations (2, n, 4)."""
    generator = np.random.default_rng(0)
    position = np.zeros((2, DRAWN, 3))
    position[1] = generator.uniform(-1.2, 1.2, (DRAWN, 3))
    rotation = quaternion.normalise(generator.normal(size=(2, DRAWN, 4)))
    call, points = kernel_call(a, b, position, rotation)
    call()
    start, count, depth = points[0], points[1], points[4]
    deepest = np.max(
        [np.where(count > k, depth[np.minimum(start + k, len(depth) - 1)], -1.0) for k in range(4)], axis=0
    )
    kept = np.nonzero((deepest > 0.0) & (deepest < DEEPEST))[0][:POSES]
    return position[:, kept], rotation[:, kept]


def kernel_call(a: Shape, b: Shape, position: Floats, rotation: Floats) -> tuple[Callable[[], object], Points]:
    """Return a call of the kernel, and where it writes."""
    n, room = position.shape[1], MOST_POINTS * position.shape[1]
    size, which = np.zeros((2, n, SHAPE_PARAMETERS)), np.arange(n)
    size[0], size[1] = a.packed(), b.packed()
    convex = [shape.geometry for shape in (a, b) if isinstance(shape, Convex)]
    points = (
        np.zeros(n, np.int64), np.zeros(n, np.int64), np.zeros(room, np.int64),
        np.zeros((room, 3)), np.zeros(room), np.zeros((room, 3)),
    )  # fmt: skip
    inputs = (
        which, which, which + n, np.zeros(n), 0, np.repeat([a.number, b.number], n), size.reshape(2 * n, -1),
        position.reshape(2 * n, 3), rotation.reshape(2 * n, 4), np.zeros(2 * n, np.int64),
        pack({0: hull_faces(convex[0])}),
    )  # fmt: skip
    kernel = STAND_INS[type(a), type(b)]
    return lambda: kernel(*inputs, *points), points


def fcl_call(a: Shape, b: Shape, position: Floats, rotation: Floats) -> Callable[[], None]:
    """Return a loop of `fcl.collide` over the same poses, the objects being there already."""
    import fcl

    sides = []
    for shape, places, turns in zip((a, b), position, rotation, strict=True):
        geometry = shape.fcl_geometry()
        placed = [quaternion.multiply(turn, Z_TO_Y) if shape.along_z else turn for turn in turns]
        sides.append(
            [
                fcl.CollisionObject(geometry, fcl.Transform(wxyz_from_xyzw(turn), place))
                for turn, place in zip(placed, places, strict=True)
            ]
        )
    request = fcl.CollisionRequest(num_max_contacts=MOST_POINTS, enable_contact=True)

    def collide() -> None:
        for one, two in zip(*sides, strict=True):
            fcl.collide(one, two, request, fcl.CollisionResult())

    return collide
