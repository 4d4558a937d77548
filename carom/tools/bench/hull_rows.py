"""Hulls: their array kernels against `fcl.collide` on the same touching poses, in alternation on one thread."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from carom.ecs.spatial import quaternion
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import hull_of
from carom.tools.bench.measure import Figure
from carom.tools.bench.narrow_rows import faster, touching

VERTICES = 20


def figures() -> Iterator[Figure]:
    """Yield how many times faster each kernel is than FCL's call.

    FCL gives one point, and a normal up to 30 degrees off; the kernels up to four and the least overlap there is.
    """
    points = quaternion.normalise(np.random.default_rng(3).normal(size=(VERTICES, 4)))[:, :3]
    hull = Convex(hull_of(points * [0.4, 0.5, 0.6]))
    pairs = {
        "hull-hull": (hull, hull, 1.0),
        "box-hull": (Box((0.3, 0.5, 0.8)), hull, 1.3),
        "capsule-hull": (Capsule(0.2, 0.7), hull, 3.0),
    }
    for name, (a, b, bound) in pairs.items():
        yield faster(f"{name} of {VERTICES} vertices, touching", a, b, *touching(a, b), bound)
