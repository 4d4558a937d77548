"""Validity: what no contact may be, whoever measured it."""

from __future__ import annotations

from math import inf, sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import MEASURED, UNIT_NORMAL
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.narrow import PLANE_SHAPE, find_measured
from carom.systems.kernels.spatial import turn

SOUND, NOT_FINITE, NOT_UNIT, TOO_DEEP, TOO_FAR = range(5)


@shared("count", "feature", "normal", "depth", "point", "fault", "value", "limit", "numbers", makes_arrays=True)
def refuse_points(
    crew, pairs, reaches, shape, size, local, bound_center, bound_half, bound_radius, position, rotation,
    start, count, feature, normal, depth, point, fault, value, limit, numbers,
):  # fmt: skip
    """Drop points that are no contacts, and write the first fault of each pair.

    ``fault[p]`` says what is wrong, ``value[p]`` is what was received and ``limit[p]`` the end of what is accepted.
    Each thread has a row of ``numbers``: how many points are kept and how many dropped.
    """
    kept, dropped = 0, 0
    begin, end = part_of(crew, len(pairs))
    fault[begin:end] = SOUND
    measured = np.empty(end - begin, np.int64)
    for p in measured[: find_measured(begin, end, count, measured)]:
        a, b = pairs[p, 0], pairs[p, 1]
        deepest, farthest = inf, (1.0 + MEASURED) * reaches[p] + MEASURED
        greatest = 0.0
        for source in range(start[p], start[p] + count[p]):
            greatest = max(greatest, depth[source])
        small = bound_radius[a] + bound_half[a, 0] + bound_radius[b] + bound_half[b, 0]  # less than both balls
        if greatest > (0.0 if shape[a] == PLANE_SHAPE or shape[b] == PLANE_SHAPE else small):
            ball_a = radius_about(a, local, bound_center, bound_half, bound_radius)
            ball_b = radius_about(b, local, bound_center, bound_half, bound_radius)
            deepest = greatest_depth(a, b, ball_a, ball_b, shape, size, position, rotation)
            deepest = (1.0 + MEASURED) * deepest + MEASURED
        to = start[p]
        for source in range(start[p], start[p] + count[p]):
            x, y, z = normal[source, 0], normal[source, 1], normal[source, 2]
            sum_of_all = point[source, 0] + point[source, 1] + point[source, 2] + x + y + z + depth[source]
            length = sqrt(x * x + y * y + z * z)
            if not np.isfinite(sum_of_all):
                wrong, received, bound = NOT_FINITE, sum_of_all, inf
            elif not abs(length - 1.0) <= UNIT_NORMAL:
                wrong, received, bound = NOT_UNIT, length, 1.0
            elif depth[source] > deepest:
                wrong, received, bound = TOO_DEEP, depth[source], deepest
            elif -depth[source] > farthest:
                wrong, received, bound = TOO_FAR, -depth[source], farthest
            else:
                if to != source:
                    feature[to], depth[to] = feature[source], depth[source]
                    for k in range(3):
                        normal[to, k], point[to, k] = normal[source, k], point[source, k]
                to += 1
                continue
            if fault[p] == SOUND:
                fault[p], value[p], limit[p] = wrong, received, bound
            dropped += 1
        count[p] = to - start[p]
        kept += count[p]
    numbers[crew[1], 0], numbers[crew[1], 1] = kept, dropped


@inlined
def radius_about(collider, local, bound_center, bound_half, bound_radius):
    """Return the radius of a ball about a collider's position that holds its shape; infinite for a half space."""
    away, half = 0.0, 0.0
    for k in range(3):
        away += (bound_center[collider, k] - local[collider, k]) ** 2
        half += bound_half[collider, k] ** 2
    return sqrt(away) + sqrt(half) + bound_radius[collider]


@inlined
def greatest_depth(a, b, ball_a, ball_b, shape, size, position, rotation):
    """Return how deep two shapes can overlap at most: as the balls that hold them would concentrically.

    No shape overlaps a half space by more than its ball does where it is. Along the line of the centres two shapes
    overlap by no more than their balls, and the depth of a contact is the least overlap of all directions.
    """
    if shape[a] != PLANE_SHAPE and shape[b] != PLANE_SHAPE:
        return ball_a + ball_b
    ball = min(ball_a, ball_b)  # that of the other one: a half space has an infinite one
    if shape[b] == PLANE_SHAPE:
        a, b = b, a
    x, y, z = turn(
        rotation[a, 0], rotation[a, 1], rotation[a, 2], rotation[a, 3], size[a, 0], size[a, 1], size[a, 2]
    )  # fmt: skip
    height = -size[a, 3]
    height += x * (position[b, 0] - position[a, 0]) + y * (position[b, 1] - position[a, 1])
    height += z * (position[b, 2] - position[a, 2])
    return max(ball - height, 0.0)
