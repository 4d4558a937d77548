"""The end of a substep."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.blows import depth_now
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.spatial import turn


@kernel("linear", "angular", "position", "depth")
def finish_drift(
    rows, count, ended, center_of_mass, freedom, start_position, start_rotation, decay, angular_decay, flow, rotation,
    body_a, body_b, normal, offset_a, offset_b, kind, start_center, turned,
    linear, angular, position, center, depth,
):  # fmt: skip
    """End the substep: the second half of drag, the depths contacts have come to, and the origins placed."""
    for c in range(count):
        if kind[c] < 0:
            depth[c] = depth_now(
                c, body_a[c], body_b[c], normal, depth, offset_a, offset_b, start_center, center, turned
            )
    for i in rows:
        qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
        cx, cy, cz = center_of_mass[i, 0], center_of_mass[i, 1], center_of_mass[i, 2]
        x, y, z = turn(qx, qy, qz, qw, cx, cy, cz)
        position[i, 0], position[i, 1], position[i, 2] = center[i, 0] - x, center[i, 1] - y, center[i, 2] - z
        if freedom[i, 0] + freedom[i, 1] + freedom[i, 2] < 3.0:  # not by way of the centre, which rounds
            qx, qy, qz, qw = start_rotation[i, 0], start_rotation[i, 1], start_rotation[i, 2], start_rotation[i, 3]
            sx, sy, sz = turn(qx, qy, qz, qw, cx, cy, cz)
            for k, moved in enumerate((sx - x, sy - y, sz - z)):
                if freedom[i, k] == 0.0:
                    position[i, k] = start_position[i, k] + moved
        for k in range(3):
            if ended and decay[i] != 1.0:
                linear[i, k] = flow[i, k] + (linear[i, k] - flow[i, k]) * decay[i]
            if ended:
                angular[i, k] *= angular_decay[i]
