"""FCL's path: what a pair costs from its two colliders to its contacts, for every pair of shapes but meshes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import combinations_with_replacement

import numpy as np

from carom.ecs import ColliderPose
from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.detection.fcl_pairs import measure_by_fcl
from carom.systems.detection.narrow import Points
from carom.systems.kernels.reduction import MOST_POINTS
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.shape import Shape
from carom.systems.shapes.sphere import Sphere
from carom.systems.simulation import Simulation
from carom.tools.bench.measure import Figure, figure, timed

POSES, REPEATS, BOUND = 1000, 7, 20.0  # us
FAR, REACH = 3.0, 0.01  # m: where the shapes below are apart, and how far a step looks ahead


def shapes() -> tuple[Shape, ...]:
    """Return a shape of each kind, all about 1 m large."""
    points = quaternion.normalise(np.random.default_rng(3).normal(size=(20, 4)))[:, :3]
    return (
        Sphere(0.5), Box((0.6, 0.8, 1.0)), Capsule(0.3, 0.8), Cylinder(0.4, 1.0), Cone(0.4, 1.0),
        Ellipsoid((0.3, 0.5, 0.4)), Convex(hull_of(points * [0.4, 0.5, 0.6])), Plane((0.0, 1.0, 0.0)),
    )  # fmt: skip


def figures() -> Iterator[Figure]:
    """Yield the time of a pair of each kind, and the longest of all again."""
    found = []
    for a, b in combinations_with_replacement(shapes(), 2):
        if not (a.static and b.static):
            call = near(a, b)
            call()
            found.append(figure(f"FCL path, {a.key}-{b.key}", "us", timed(call, REPEATS), BOUND, 1e6 / POSES))
            yield found[-1]
    longest = max(found, key=lambda one: one.cpu)
    yield replace(longest, name=longest.name.replace("path,", "path, longest:"))


def near(a: Shape, b: Shape) -> Callable[[], int]:
    """Return a call that measures a pair in many random poses.

    Half of them are within 1 % of the smaller width of touching, and the others overlap by up to 5 % of it. They are
    placed by what is measured: moved along the normal by what is missing.
    """
    n, generator = POSES, np.random.default_rng(0)
    simulation = Simulation(checked=False)
    for shape in (a, b):
        body = None if shape.static else {"mass": 1.0}
        simulation.add_many(np.zeros((n, 3)), collider={"shape": shape}, body=body, visual=False)
    world = simulation.world
    width = min(shape.bounds().width for shape in (a, b) if not shape.static)
    close = generator.random(n) < 0.5
    wanted = width * np.where(close, generator.uniform(-0.01, 0.01, n), generator.uniform(0.0, 0.05, n))
    rotation = quaternion.normalise(generator.normal(size=(2 * n, 4)))
    position: Floats = FAR * quaternion.normalise(generator.normal(size=(n, 3)))
    pairs, which = np.stack([np.arange(n), np.arange(n, 2 * n)], axis=1), np.arange(n)

    def measured(reach: float) -> Points:
        points = Points(n, MOST_POINTS * n)
        with world.faces(None):
            measure_by_fcl(world, which, pairs, np.full(n, reach), points)
        return points

    for _ in range(3):
        with world.edit(ColliderPose) as pose:
            pose.position[n : 2 * n], pose.rotation[: 2 * n] = position, rotation
        points = measured(4.0 * FAR)
        deepest = np.array([points.depth[s : s + c].max() for s, c in zip(points.start, points.count, strict=True)])
        position -= points.normal[points.start] * (wanted - deepest)[:, None]
    points, reaches = Points(n, MOST_POINTS * n), np.full(n, REACH)

    def call() -> int:
        with world.faces(None):
            return measure_by_fcl(world, which, pairs, reaches, points)

    return call
