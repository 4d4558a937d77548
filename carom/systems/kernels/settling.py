"""The end of a substep."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import PUSH_OUT, SLOP
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.spatial import cross, turn


@kernel("linear", "angular", "position", "center", "depth")
def finish_drift(
    rows, count, h, ended, center_of_mass, inverse_mass, decay, angular_decay, flow, rotation,
    body_a, body_b, normal, offset_a, offset_b, kind, resting, start_center,
    linear, angular, position, center, depth,
):  # fmt: skip
    """End the substep: the second half of drag, overlap pushed out without adding velocity, and the origins placed."""
    for c in range(count):
        a, b = body_a[c], body_b[c]
        if kind[c] < 0:
            ax, ay, az, bx, by, bz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
            if a >= 0:
                ax, ay, az = cross(
                    angular[a, 0], angular[a, 1], angular[a, 2], offset_a[c, 0], offset_a[c, 1], offset_a[c, 2]
                )
                ax += (center[a, 0] - start_center[a, 0]) / h
                ay += (center[a, 1] - start_center[a, 1]) / h
                az += (center[a, 2] - start_center[a, 2]) / h
            if b >= 0:
                bx, by, bz = cross(
                    angular[b, 0], angular[b, 1], angular[b, 2], offset_b[c, 0], offset_b[c, 1], offset_b[c, 2]
                )
                bx += (center[b, 0] - start_center[b, 0]) / h
                by += (center[b, 1] - start_center[b, 1]) / h
                bz += (center[b, 2] - start_center[b, 2]) / h
            depth[c] -= h * (normal[c, 0] * (bx - ax) + normal[c, 1] * (by - ay) + normal[c, 2] * (bz - az))
    for c in range(count):
        if resting[c] and depth[c] > SLOP:
            a, b = body_a[c], body_b[c]
            total = (inverse_mass[a] if a >= 0 else 0.0) + (inverse_mass[b] if b >= 0 else 0.0)
            if total > 0.0:
                share = PUSH_OUT * (depth[c] - SLOP) / total
                for k in range(3):
                    if a >= 0:
                        center[a, k] -= share * inverse_mass[a] * normal[c, k]
                    if b >= 0:
                        center[b, k] += share * inverse_mass[b] * normal[c, k]
                depth[c] -= PUSH_OUT * (depth[c] - SLOP)
    for i in rows:
        qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
        cx, cy, cz = center_of_mass[i, 0], center_of_mass[i, 1], center_of_mass[i, 2]
        x, y, z = turn(qx, qy, qz, qw, cx, cy, cz)
        position[i, 0], position[i, 1], position[i, 2] = center[i, 0] - x, center[i, 1] - y, center[i, 2] - z
        for k in range(3):
            if ended and decay[i] != 1.0:
                linear[i, k] = flow[i, k] + (linear[i, k] - flow[i, k]) * decay[i]
            if ended:
                angular[i, k] *= angular_decay[i]
