"""Convex solids with how far a point is outside of each, by formulas that know nothing of rays."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.shapes import Shape
from carom.systems.shapes.geometry import hull_of

CORNERS = np.array(
    [(0.5, 0.1, 0.0), (-0.6, 0.0, 0.1), (0.0, 0.7, 0.0), (0.1, -0.5, 0.2), (0.0, 0.1, 0.6), (0.2, 0.0, -0.5)]
)


def hull_outside(x: Floats) -> Floats:
    """Return how far points are outside the planes of the hull of CORNERS."""
    geometry = hull_of(CORNERS)
    a, b, c = (geometry.vertices[geometry.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    found: Floats = (x @ normals.T - (normals * a).sum(axis=1)).max(axis=1)
    return found


def about_axis(x: Floats) -> Floats:
    """Return how far points are from the y axis."""
    return np.hypot(x[:, 0], x[:, 2])


#: Words of a collider, and a convex function of places (n, 3) in its frame, m: 0 on its surface, negative inside.
SOLIDS: dict[str, tuple[dict[str, Any], Callable[[Floats], Floats]]] = {
    "sphere": ({"sphere": {"radius": 0.5}}, lambda x: np.linalg.norm(x, axis=1) - 0.5),
    "box": (
        {"box": {"size": (1.0, 0.6, 1.4)}},
        lambda x: (np.abs(x) - np.array([0.5, 0.3, 0.7])).max(axis=1),
    ),
    "capsule": (
        {"capsule": {"radius": 0.3, "length": 0.8}},
        lambda x: (
            np.linalg.norm(x - np.stack([0 * x[:, 0], np.clip(x[:, 1], -0.4, 0.4), 0 * x[:, 0]], 1), axis=1) - 0.3
        ),
    ),
    "cylinder": (
        {"cylinder": {"radius": 0.4, "length": 1.0}},
        lambda x: np.maximum(about_axis(x) - 0.4, np.abs(x[:, 1]) - 0.5),
    ),
    "cone": (
        {"cone": {"radius": 0.5, "length": 1.2}},
        lambda x: np.maximum(about_axis(x) - 0.5 / 1.2 * (0.6 - x[:, 1]), -x[:, 1] - 0.6),
    ),
    "ellipsoid": (
        {"ellipsoid": {"radii": (0.6, 0.4, 0.3)}},
        lambda x: np.linalg.norm(x / np.array([0.6, 0.4, 0.3]), axis=1) - 1.0,
    ),
    "convex": ({"convex": {"points": CORNERS}}, hull_outside),
    "plane": ({"plane": {"normal": (0.0, 0.6, 0.8), "offset": 0.1}}, lambda x: x @ np.array([0.0, 0.6, 0.8]) - 0.1),
}


def first_within(outside: Callable[[Floats], Floats], origin: Floats, direction: Floats, far: float) -> Floats:
    """Return where rays enter a convex solid, infinite where they miss it, by search: m.

    Along a ray the function is convex: its least value is found by thirds, and where it becomes 0 by halves.
    """
    low, high = np.zeros(len(origin)), np.full(len(origin), far)
    for _ in range(400):
        one, other = low + (high - low) / 3.0, high - (high - low) / 3.0
        less = outside(origin + one[:, None] * direction) < outside(origin + other[:, None] * direction)
        low, high = np.where(less, low, one), np.where(less, other, high)
    least = 0.5 * (low + high)
    meets = outside(origin + least[:, None] * direction) < 0.0
    low, high = np.zeros(len(origin)), least
    for _ in range(200):
        middle = 0.5 * (low + high)
        inside = outside(origin + middle[:, None] * direction) < 0.0
        low, high = np.where(inside, low, middle), np.where(inside, middle, high)
    return np.where(meets, high, np.inf)


def reaching(shape: Shape, position: Any, rotation: Any, normal: Floats) -> Floats:
    """Return how far a shape in one or many places reaches along unit vectors (n, 3)."""
    local = quaternion.rotate(quaternion.conjugate(np.broadcast_to(rotation, (len(normal), 4))), normal)
    reached: Floats = (local * shape.support(local)).sum(axis=1) + (normal * position).sum(axis=1)
    return reached
