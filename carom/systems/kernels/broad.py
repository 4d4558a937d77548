"""Broad phase: where colliders are, how far they reach within the step, and which bounds overlap."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import REACH_FACTOR, REACH_SLACK
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.spatial import product, turn


@kernel("reach", "detected_center")
def foresee_reach(
    rows, dt, pull, position, rotation, linear, center_of_mass, last_acceleration, reach, detected_center
):  # fmt: skip
    """Say how far each body may travel within ``dt``: its speed and acceleration, or gravity's ``pull`` if greater."""
    for i in rows:
        ox, oy, oz = turn(
            rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3],
            center_of_mass[i, 0], center_of_mass[i, 1], center_of_mass[i, 2],
        )  # fmt: skip
        detected_center[i, 0], detected_center[i, 1], detected_center[i, 2] = (
            position[i, 0] + ox, position[i, 1] + oy, position[i, 2] + oz,
        )  # fmt: skip
        speed, push = 0.0, 0.0
        for k in range(3):
            speed += linear[i, k] * linear[i, k]
            push += last_acceleration[i, k] * last_acceleration[i, k]
        reach[i] = REACH_SLACK + REACH_FACTOR * (sqrt(speed) + max(pull, sqrt(push)) * dt) * dt


@kernel("pose_position", "pose_rotation", "lower", "upper", "body_row")
def place_bounds(
    rows, dt, body, angular, reach, center_of_mass, position, rotation, local_position, local_rotation,
    bound_center, bound_half, bound_radius, pose_position, pose_rotation, lower, upper, body_row,
):  # fmt: skip
    """Place each collider in the world and bound all it can reach: |R| half extents + radius + reach + turning.

    What reaches and turns is its ``body``, a row or -1; turning moves no point farther than twice its distance from
    the centre of mass.
    """
    for i in rows:
        qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
        x, y, z = turn(qx, qy, qz, qw, local_position[i, 0], local_position[i, 1], local_position[i, 2])
        pose_position[i, 0], pose_position[i, 1], pose_position[i, 2] = (
            position[i, 0] + x, position[i, 1] + y, position[i, 2] + z,
        )  # fmt: skip
        pose_rotation[i, 0], pose_rotation[i, 1], pose_rotation[i, 2], pose_rotation[i, 3] = product(
            qx, qy, qz, qw, local_rotation[i, 0], local_rotation[i, 1], local_rotation[i, 2], local_rotation[i, 3]
        )
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


@kernel("found")
def sweep_bounds(
    finite, planes, size, lower, upper, body_row, layer, mask, sensor, pose_position, pose_rotation, found
):
    """Write pairs of collider rows, lower first, whose bounds overlap and whose layers both accept; return their count.

    Where the count exceeds the rows of ``found`` (n, 2), the caller must call again with more room.

    ``finite`` are the rows with finite bounds in order of their lower x: sort and sweep. Half spaces are tested against
    every box. Pairs without a moving body, within one body, or of two sensors are left out.
    """
    n = len(finite)
    count = 0
    for s in range(n + len(planes)):
        i = finite[s] if s < n else planes[s - n]
        nx, ny, nz = 0.0, 0.0, 0.0
        if s >= n:
            nx, ny, nz = turn(
                pose_rotation[i, 0], pose_rotation[i, 1], pose_rotation[i, 2], pose_rotation[i, 3],
                size[i, 0], size[i, 1], size[i, 2],
            )  # fmt: skip
        for t in range(s + 1 if s < n else 0, n):
            j = finite[t]
            if s < n:
                if lower[j, 0] > upper[i, 0]:
                    break
                if (
                    lower[j, 1] > upper[i, 1] or lower[i, 1] > upper[j, 1]
                    or lower[j, 2] > upper[i, 2] or lower[i, 2] > upper[j, 2]
                ):  # fmt: skip
                    continue
            else:
                x = lower[j, 0] if nx > 0.0 else upper[j, 0]
                y = lower[j, 1] if ny > 0.0 else upper[j, 1]
                z = lower[j, 2] if nz > 0.0 else upper[j, 2]
                x, y, z = x - pose_position[i, 0], y - pose_position[i, 1], z - pose_position[i, 2]
                if nx * x + ny * y + nz * z > size[i, 3]:
                    continue
            if body_row[i] == body_row[j]:
                continue
            if (mask[i] & layer[j]) == 0 or (mask[j] & layer[i]) == 0 or (sensor[i] and sensor[j]):
                continue
            if count < len(found):
                found[count, 0] = i if i < j else j
                found[count, 1] = j if i < j else i
            count += 1
    return count
