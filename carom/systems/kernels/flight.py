"""Kernels of free motion: prediction to the middle of the substep, acceleration, kick."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.bodies import turned_by
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.spatial import exponential, product, turn

EULER, SEMI_IMPLICIT, VERLET = 0, 1, 2


@kernel(
    "position", "rotation", "linear", "angular",
    "center", "start_center", "start_position", "start_rotation", "start_linear", "start_angular",
)  # fmt: skip
def predict_middle(
    rows, half, center_of_mass, freedom, last_acceleration, last_angular_acceleration,
    position, rotation, linear, angular,
    center, start_center, start_position, start_rotation, start_linear, start_angular,
):  # fmt: skip
    """Save where bodies are and move them ``half`` seconds on along their arcs, for forces to be evaluated there.

    Along and about locked axes they are at rest, whatever velocity was set from outside.
    The middle velocity uses the acceleration of the substep before, which keeps velocity Verlet of second order also
    with forces that depend on velocity.
    """
    for i in rows:
        qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
        cx, cy, cz = center_of_mass[i, 0], center_of_mass[i, 1], center_of_mass[i, 2]
        off_origin = cx != 0.0 or cy != 0.0 or cz != 0.0
        offset = (0.0, 0.0, 0.0)
        if off_origin:
            ox, oy, oz = turn(qx, qy, qz, qw, cx, cy, cz)
            offset = (ox, oy, oz)
        for k in range(3):
            if freedom[i, k] == 0.0:
                linear[i, k] = 0.0
            if freedom[i, 3 + k] == 0.0:
                angular[i, k] = 0.0
            start_position[i, k] = position[i, k]
            start_linear[i, k] = linear[i, k]
            start_angular[i, k] = angular[i, k]
            center[i, k] = position[i, k] + offset[k]
            start_center[i, k] = center[i, k]
        for k in range(4):
            start_rotation[i, k] = rotation[i, k]
        if half == 0.0:
            continue
        # Straight on and back to length 1, which is a turn up to the third order.
        nx, ny, nz, nw = product(
            0.5 * half * angular[i, 0], 0.5 * half * angular[i, 1], 0.5 * half * angular[i, 2], 1.0, qx, qy, qz, qw
        )
        inverse = 1.0 / sqrt(nx * nx + ny * ny + nz * nz + nw * nw)
        nx, ny, nz, nw = nx * inverse, ny * inverse, nz * inverse, nw * inverse
        rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3] = nx, ny, nz, nw
        if off_origin:
            ox, oy, oz = turn(nx, ny, nz, nw, cx, cy, cz)
            offset = (ox, oy, oz)
        for k in range(3):
            position[i, k] = center[i, k] + half * linear[i, k] - offset[k]
            linear[i, k] += half * last_acceleration[i, k]
            angular[i, k] += half * last_angular_acceleration[i, k]


@kernel("position", "rotation", "linear", "angular", "felt", "angular_acceleration", "time", "turned", "touching")
def accelerate(
    rows, inverse_mass, inverse_inertia, principal_axes, freedom, force, torque, external_force, external_torque,
    start_position, start_rotation, start_linear, start_angular,
    position, rotation, linear, angular, felt, angular_acceleration, time, turned, touching,
):  # fmt: skip
    """Turn forces into accelerations at the middle of the substep and bring the bodies back to its start."""
    for i in rows:
        x, y, z = torque[i, 0], torque[i, 1], torque[i, 2]
        x, y, z = x + external_torque[i, 0], y + external_torque[i, 1], z + external_torque[i, 2]
        ax, ay, az = 0.0, 0.0, 0.0
        if x != 0.0 or y != 0.0 or z != 0.0:
            ax, ay, az = turned_by(i, x, y, z, inverse_inertia, principal_axes, freedom, rotation)
        angular_acceleration[i, 0], angular_acceleration[i, 1], angular_acceleration[i, 2] = ax, ay, az
        for k in range(3):
            felt[i, k] = (force[i, k] + external_force[i, k]) * inverse_mass[i] * freedom[i, k]
            position[i, k] = start_position[i, k]
            linear[i, k] = start_linear[i, k]
            angular[i, k] = start_angular[i, k]
            turned[i, k] = 0.0
        for k in range(4):
            rotation[i, k] = start_rotation[i, k]
        time[i] = 0.0
        touching[i] = False


@kernel(
    "linear", "angular", "acceleration", "angular_acceleration", "decay", "angular_decay", "flow",
    "last_acceleration", "last_angular_acceleration",
)  # fmt: skip
def kick_bodies(
    rows, h, integrator, inverse_mass, freedom, drag, drag_flow, angular_drag, felt, touching,
    linear, angular, acceleration, angular_acceleration, decay, angular_decay, flow,
    last_acceleration, last_angular_acceleration,
):  # fmt: skip
    """Set each body's arc by the integrator; bodies in contact are stepped semi-implicitly whatever it is.

    Drag relaxes the velocity towards the flow by a factor exp(-rate h): all of it before the drift (semi-implicit),
    after it (Euler), or half before and half after (Verlet, Strang's splitting, which keeps second order).
    """
    for i in rows:
        scheme = SEMI_IMPLICIT if touching[i] else integrator
        before = 1.0
        decay[i], angular_decay[i] = 1.0, 1.0
        rate = drag[i] * inverse_mass[i]
        for k in range(3):
            last_acceleration[i, k] = 0.0 if scheme == SEMI_IMPLICIT else felt[i, k]
        if rate > 0.0:
            for k in range(3):
                flow[i, k] = drag_flow[i, k] / drag[i] * freedom[i, k]
            if scheme == VERLET:
                before = exponential(-0.5 * rate * h)
                decay[i] = before
                for k in range(3):  # the middle of the next substep is predicted with drag too
                    last_acceleration[i, k] += (flow[i, k] - linear[i, k]) * (1.0 - before) / (0.5 * h)
            elif scheme == SEMI_IMPLICIT:
                before = exponential(-rate * h)
            else:
                decay[i] = exponential(-rate * h)
            for k in range(3):
                linear[i, k] = flow[i, k] + (linear[i, k] - flow[i, k]) * before
        for k in range(3):
            last_angular_acceleration[i, k] = 0.0 if scheme == SEMI_IMPLICIT else angular_acceleration[i, k]
        if angular_drag[i] > 0.0 and inverse_mass[i] > 0.0:
            before = 1.0
            if scheme == VERLET:
                before = exponential(-0.5 * angular_drag[i] * h)
                angular_decay[i] = before
                for k in range(3):
                    last_angular_acceleration[i, k] -= angular[i, k] * (1.0 - before) / (0.5 * h)
            elif scheme == SEMI_IMPLICIT:
                before = exponential(-angular_drag[i] * h)
            else:
                angular_decay[i] = exponential(-angular_drag[i] * h)
            for k in range(3):
                angular[i, k] *= before
        for k in range(3):
            if scheme == SEMI_IMPLICIT:
                linear[i, k] += h * felt[i, k]
                angular[i, k] += h * angular_acceleration[i, k]
                acceleration[i, k] = 0.0
                angular_acceleration[i, k] = 0.0
            else:
                acceleration[i, k] = felt[i, k]


@kernel()
def first_not_finite(rows, position, rotation, linear, angular):
    """Return the first row with a NaN or infinity in its pose or velocity, -1 for none."""
    for i in rows:
        total = rotation[i, 0] + rotation[i, 1] + rotation[i, 2] + rotation[i, 3]
        for k in range(3):
            total += position[i, k] + linear[i, k] + angular[i, k]
        if total - total != 0.0:  # neither NaN nor infinity less itself is 0
            return i
    return -1
