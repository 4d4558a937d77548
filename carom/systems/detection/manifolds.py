"""Manifolds: which points stand for a contact area."""

from __future__ import annotations

import numpy as np

from carom.ecs.column import Floats
from carom.systems.constants import SAME_NORMAL, SAME_SPOT
from carom.systems.kernels.reduction import LATER, choose_of_area

Points = list[tuple[Floats, Floats, float]]


def under_plane(corners: Floats, radius: float, normal: Floats, origin: Floats, reach: float) -> Points:
    """Return a point per corner ball (n, 3) nearer than ``reach`` to the half space under ``origin``."""
    away = corners - origin
    gaps = away[:, 0] * normal[0] + away[:, 1] * normal[1] + away[:, 2] * normal[2] - radius
    near = np.nonzero(gaps < reach)[0]
    return [(corners[k] - normal * (radius + gaps[k] / 2.0), normal, -float(gaps[k])) for k in near]


def reduce_points(points: Points) -> Points:
    """Keep the points that stand for the area (`reduce_area`)."""
    if not points:
        return points
    place = np.array([p for p, _, _ in points]).ravel()
    names = np.arange(len(points))
    kept = choose_of_area(place, -np.array([d for _, _, d in points]), names, *points[0][1])
    return [points[k] for k in sorted((names[:kept] % LATER).tolist())]


def merge_triangles(points: Points) -> Points:
    """Keep the deepest of the points that several triangles report for one contact."""
    kept: Points = []
    for point, normal, depth in sorted(points, key=lambda p: -p[2]):
        near = any((normal * n).sum() > SAME_NORMAL and ((point - p) ** 2).sum() < SAME_SPOT**2 for p, n, _ in kept)
        if not near:
            kept.append((point, normal, depth))
    return kept
