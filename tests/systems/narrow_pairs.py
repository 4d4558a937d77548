"""Pairs of shapes, posed, for tests of the narrow phase."""

from __future__ import annotations

from typing import Any

import numpy as np
from batches import Answer, Batch, measure_batch

from carom.ecs.spatial import quaternion
from carom.systems.shapes import Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.sphere import Sphere

BOX, SMALL_BOX = Box((0.6, 0.4, 0.9)), Box((0.3, 0.5, 0.8))
CAPSULE, SHORT_CAPSULE = Capsule(0.4, 1.1), Capsule(0.3, 0.8)
SPHERE, PLANE = Sphere(0.7), Plane((0.0, 3.0, 4.0), 1.0)
PAIRS: dict[str, tuple[Shape, Shape]] = {
    "box-box": (BOX, SMALL_BOX),
    "box-plane": (SMALL_BOX, PLANE),
    "capsule-capsule": (CAPSULE, SHORT_CAPSULE),
    "capsule-box": (CAPSULE, SMALL_BOX),
    "capsule-plane": (CAPSULE, PLANE),
    "sphere-capsule": (SPHERE, CAPSULE),
    "sphere-sphere": (SPHERE, Sphere(0.3)),
    "sphere-box": (SPHERE, SMALL_BOX),
    "sphere-plane": (SPHERE, PLANE),
}
LEVEL = np.array(quaternion.IDENTITY)


def check_valid(answer: Answer, reach: float, most: float) -> None:
    """Hold contacts to what every contact must be."""
    assert np.isfinite(answer.depth).all()
    assert np.isfinite(answer.point).all()
    assert np.abs((answer.normal**2).sum(axis=1) - 1.0).max(initial=0.0) < 1e-12
    assert ((answer.depth >= -reach) & (answer.depth <= most)).all()


def lone(a: Shape, b: Shape, at: Any, rotation_a: Any = LEVEL, rotation_b: Any = LEVEL, reach: float = 0.0) -> Answer:
    """Measure one pose."""
    return measure_batch(a, b, Batch(*(np.array([v], np.float64) for v in (rotation_a, at, rotation_b))), reach)
