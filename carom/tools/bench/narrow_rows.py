"""Narrow phase: the array kernels against `fcl.collide` on the same touching poses, in alternation on one thread."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.components.collider import SHAPE_PARAMETERS
from carom.ecs.spatial import quaternion
from carom.systems.detection.hulls import pack
from carom.systems.detection.meshes import joined
from carom.systems.detection.narrow import STAND_INS
from carom.systems.kernels.crew import ALONE
from carom.systems.kernels.reduction import MOST_POINTS
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.orientation import Z_TO_Y, wxyz_from_xyzw
from carom.systems.shapes.polyhedron import hull_faces
from carom.systems.shapes.shape import Shape
from carom.systems.shapes.sphere import Sphere
from carom.tools.bench.measure import Figure, compared, figure

POSES = 10_000
DRAWN = 50 * POSES  # of which those that touch are kept
DEEPEST = 0.05  # m
REPEATS = 7
CALLS = 5  # of the kernel in a repeat
BOXES = (Box((0.6, 0.4, 0.9)), Box((0.3, 0.5, 0.8)))
BOUND = 30.0  # times as fast as FCL
MANIFOLD = "box-box manifold"  # face on face, as in piles; in any pose four of five touch by edges, at one point
PAIRS: dict[str, tuple[Shape, Shape]] = {
    MANIFOLD: BOXES,
    "box-box, any pose": BOXES,
    "sphere-box": (Sphere(0.5), Box((0.3, 0.5, 0.8))),
    "capsule-capsule": (Capsule(0.4, 1.1), Capsule(0.3, 0.8)),
}


def figures() -> Iterator[Figure]:
    """Yield how many times faster each kernel is; FCL's call counts alone, with its result, not what reads it."""
    for name, (a, b) in PAIRS.items():
        position, rotation = stacked(a, b) if name == MANIFOLD else touching(a, b)
        yield faster(f"{name}, {POSES} touching", a, b, position, rotation, BOUND)


def faster(name: str, a: Shape, b: Shape, position: Floats, rotation: Floats, bound: float) -> Figure:
    """Time both sides over the same poses, in alternation."""
    by_kernel, by_fcl = kernel_call(a, b, position, rotation)[0], fcl_call(a, b, position, rotation)
    ratio = compared(by_fcl, by_kernel, REPEATS, CALLS)
    return figure(name, "x faster than FCL", ratio, bound, at_least=True)


def stacked(a: Shape, b: Shape) -> tuple[Floats, Floats]:
    """Draw poses of one box standing on another, both turned about the vertical, as `touching` gives them."""
    generator = np.random.default_rng(0)
    position, rotation = np.zeros((2, POSES, 3)), np.zeros((2, POSES, 4))
    position[1] = generator.uniform(-0.3, 0.3, (POSES, 3))
    position[1, :, 1] = a.bounds().half[1] + b.bounds().half[1] - generator.uniform(0.0, 1e-3, POSES)
    rotation[:, :, 1::2] = generator.normal(size=(2, POSES, 2))
    return position, quaternion.normalise(rotation)


def touching(a: Shape, b: Shape) -> tuple[Floats, Floats]:
    """Draw random poses that overlap by at most DEEPEST: positions (2, n, 3) and rotations (2, n, 4)."""
    generator = np.random.default_rng(0)
    reach = sum(float(np.linalg.norm(shape.bounds().half)) + shape.bounds().radius for shape in (a, b))
    position = np.zeros((2, DRAWN, 3))
    position[1] = quaternion.normalise(generator.normal(size=(DRAWN, 4)))[:, :3]
    position[1] *= reach * generator.random((DRAWN, 1)) / np.linalg.norm(position[1], axis=1, keepdims=True)
    rotation = quaternion.normalise(generator.normal(size=(2, DRAWN, 4)))
    call, count, depth = kernel_call(a, b, position, rotation)
    call()
    deepest = np.full(DRAWN, -1.0)
    np.maximum.at(deepest, np.repeat(np.arange(DRAWN), count), depth[: count.sum()])
    kept = np.nonzero((deepest > 0.0) & (deepest < DEEPEST))[0][:POSES]
    assert len(kept) == POSES, f"{len(kept)} of {DRAWN} poses touch: draw more"
    return position[:, kept], rotation[:, kept]


def kernel_call(a: Shape, b: Shape, position: Floats, rotation: Floats) -> tuple[Callable[[], Any], Integers, Floats]:
    """Return a call of the kernel, and where it writes counts and depths."""
    n = position.shape[1]
    shape, size = np.repeat([a.number, b.number], n), np.zeros((2, n, SHAPE_PARAMETERS))
    size[0], size[1] = a.packed(), b.packed()
    which, start, count = np.arange(n), np.zeros(n, np.int64), np.zeros(n, np.int64)
    room = MOST_POINTS * n
    feature, depth, normal, point = np.zeros(room, np.int64), np.zeros(room), np.zeros((room, 3)), np.zeros((room, 3))
    hulls = [hull_faces(b.geometry)] if isinstance(b, Convex) else []
    inputs = (
        ALONE, which, which, which + n, np.zeros(n), 0, MOST_POINTS,
        shape, size.reshape(2 * n, -1), position.reshape(2 * n, 3), rotation.reshape(2 * n, 4),
        np.zeros(2 * n, np.int64), pack(dict(enumerate(hulls))), joined({}), np.zeros(n),
    )  # fmt: skip
    kernel = STAND_INS[type(a), type(b)]
    return lambda: kernel(*inputs, start, count, feature, normal, depth, point), count, depth


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
