"""Validity: what no contact may be, whoever measured it."""

from __future__ import annotations

from math import inf, sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import UNIT_NORMAL
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.narrow import PLANE_SHAPE
from carom.systems.kernels.spatial import turn

SOUND, NOT_FINITE, NOT_UNIT, TOO_DEEP, TOO_FAR = range(5)


@woven
def fault_of(nx, ny, nz, depth, x, y, z, deepest, farthest):
    """Return what is wrong with a point, `SOUND` if nothing is, what was received, and the end of what is accepted.

    It is at x, with normal n.
    """
    sum_of_all = x + y + z + nx + ny + nz + depth
    length = sqrt(nx * nx + ny * ny + nz * nz)
    if not np.isfinite(sum_of_all):
        return NOT_FINITE, sum_of_all, inf
    if not abs(length - 1.0) <= UNIT_NORMAL:
        return NOT_UNIT, length, 1.0
    if depth > deepest:
        return TOO_DEEP, depth, deepest
    if -depth > farthest:
        return TOO_FAR, -depth, farthest
    return SOUND, 0.0, 0.0


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
