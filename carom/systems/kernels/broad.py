"""Broad phase: where colliders are, and how far they reach within the step."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import REACH_FACTOR, REACH_SLACK, REACH_SMALL, REACH_STIRRED
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.spatial import product, turn


@kernel("reach", "detected_center")
def foresee_reach(
    rows, dt, pull, position, rotation, linear, center_of_mass, inertia, inverse_mass, last_acceleration,
    reach, detected_center,
):  # fmt: skip
    """Say how far each body may travel within ``dt``: its speed and acceleration, or gravity's ``pull`` if greater.

    Those that are struck travel farther. Where many move they all are given more: the mean of the ways of all, each up
    to REACH_STIRRED of its least radius of gyration. But small ones are given no more than REACH_SMALL of theirs.
    """
    stirred = 0.0
    for i in rows:
        way = sqrt(linear[i, 0] ** 2 + linear[i, 1] ** 2 + linear[i, 2] ** 2) * dt
        stirred += min(way, REACH_STIRRED * least_gyration(i, inertia, inverse_mass))
    slack = REACH_SLACK + stirred / max(1, len(rows))
    for i in rows:
        ox, oy, oz = turn(
            rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3],
            center_of_mass[i, 0], center_of_mass[i, 1], center_of_mass[i, 2],
        )  # fmt: skip
        detected_center[i, 0], detected_center[i, 1], detected_center[i, 2] = (
            position[i, 0] + ox, position[i, 1] + oy, position[i, 2] + oz,
        )  # fmt: skip
        small = REACH_SMALL * least_gyration(i, inertia, inverse_mass)
        own = min(slack, small) if small > 0.0 else slack
        speed, push = 0.0, 0.0
        for k in range(3):
            speed += linear[i, k] * linear[i, k]
            push += last_acceleration[i, k] * last_acceleration[i, k]
        reach[i] = own + REACH_FACTOR * (sqrt(speed) + max(pull, sqrt(push)) * dt) * dt


@woven
def least_gyration(i, inertia, inverse_mass):
    """Return the least radius of gyration of body i about its axes (m); 0 of who is moved by nothing."""
    return sqrt(min(inertia[i, 0], inertia[i, 1], inertia[i, 2]) * inverse_mass[i])


@kernel("pose_position", "pose_rotation", "lower", "upper", "body_row", "moved")
def place_bounds(
    rows, dt, body, angular, reach, center_of_mass, position, rotation, local_position, local_rotation,
    bound_center, bound_half, bound_radius, pose_position, pose_rotation, lower, upper, body_row, moved,
):  # fmt: skip
    """Place each collider in the world and bound all it can reach: |R| half extents + radius + reach + turning.

    What reaches and turns is its ``body``, a row or -1; turning moves no point farther than twice its distance from
    the centre of mass.
    """
    for i in rows:
        qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
        x, y, z = turn(qx, qy, qz, qw, local_position[i, 0], local_position[i, 1], local_position[i, 2])
        place = (position[i, 0] + x, position[i, 1] + y, position[i, 2] + z)
        turned = product(
            qx, qy, qz, qw, local_rotation[i, 0], local_rotation[i, 1], local_rotation[i, 2], local_rotation[i, 3]
        )
        moved[i] = False
        for k, value in enumerate(place):
            moved[i] |= pose_position[i, k] != value
            pose_position[i, k] = value
        for k, value in enumerate(turned):
            moved[i] |= pose_rotation[i, k] != value
            pose_rotation[i, k] = value
        hx, hy, hz = bound_half[i, 0], bound_half[i, 1], bound_half[i, 2]
        wide = bound_radius[i]
        cx, cy, cz = turn(qx, qy, qz, qw, bound_center[i, 0], bound_center[i, 1], bound_center[i, 2])
        center = (cx, cy, cz)
        b = body[i]
        body_row[i] = b
        if b >= 0:
            spin = sqrt(angular[b, 0] ** 2 + angular[b, 1] ** 2 + angular[b, 2] ** 2)
            away = 0.0
            for k in range(3):
                away += (position[i, k] + center[k] - center_of_mass[b, k]) ** 2
            wide += reach[b] + min(spin * dt, 2.0) * (sqrt(hx * hx + hy * hy + hz * hz) + sqrt(away))
        half = (hx, hy, hz)
        if hx < np.inf:  # a half space has no end whichever way it is turned
            ax, ay, az = turn(qx, qy, qz, qw, 1.0, 0.0, 0.0)
            bx, by, bz = turn(qx, qy, qz, qw, 0.0, 1.0, 0.0)
            gx, gy, gz = turn(qx, qy, qz, qw, 0.0, 0.0, 1.0)
            half = (
                abs(ax) * hx + abs(bx) * hy + abs(gx) * hz,
                abs(ay) * hx + abs(by) * hy + abs(gy) * hz,
                abs(az) * hx + abs(bz) * hy + abs(gz) * hz,
            )
        for k in range(3):
            lower[i, k] = position[i, k] + center[k] - half[k] - wide
            upper[i, k] = position[i, k] + center[k] + half[k] + wide
