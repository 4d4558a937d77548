"""Kernel of springs as forces."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.spatial import cross, turn


@kernel("length", "tension", "force", "torque")
def add_springs(
    rows, row_a, row_b, anchor_a, anchor_b, rest_length, stiffness, damping,
    position, rotation, linear, angular, center_of_mass, inverse_mass, length, tension, force, torque,
):  # fmt: skip
    """Add k (l - l0) + c dl/dt along the line from anchor to anchor; ``row_a`` and ``row_b`` are -1 for the world."""
    for number, i in enumerate(rows):
        a, b = row_a[number], row_b[number]
        px, py, pz, ax, ay, az, ux, uy, uz = end_of(
            a, anchor_a[i, 0], anchor_a[i, 1], anchor_a[i, 2], position, rotation, linear, angular, center_of_mass
        )
        qx, qy, qz, bx, by, bz, vx, vy, vz = end_of(
            b, anchor_b[i, 0], anchor_b[i, 1], anchor_b[i, 2], position, rotation, linear, angular, center_of_mass
        )
        dx, dy, dz = qx - px, qy - py, qz - pz
        distance = sqrt(dx * dx + dy * dy + dz * dz)
        inverse = 1.0 / distance if distance > 0.0 else 0.0  # where the ends meet there is no line to pull along
        dx, dy, dz = dx * inverse, dy * inverse, dz * inverse
        grows = dx * (vx - ux) + dy * (vy - uy) + dz * (vz - uz)
        pull = stiffness[i] * (distance - rest_length[i]) + damping[i] * grows
        length[i], tension[i] = distance, pull
        pull_at(a, pull * dx, pull * dy, pull * dz, ax, ay, az, inverse_mass, force, torque)
        pull_at(b, -(pull * dx), -(pull * dy), -(pull * dz), bx, by, bz, inverse_mass, force, torque)


@inlined
def end_of(i, x, y, z, position, rotation, linear, angular, center_of_mass):
    """Return an anchor in the world, where it is from the centre of mass of its body, and its velocity."""
    if i < 0:
        return x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
    px, py, pz = turn(qx, qy, qz, qw, x, y, z)
    cx, cy, cz = center_of_mass[i, 0], center_of_mass[i, 1], center_of_mass[i, 2]
    rx, ry, rz = turn(qx, qy, qz, qw, x - cx, y - cy, z - cz)
    vx, vy, vz = cross(angular[i, 0], angular[i, 1], angular[i, 2], rx, ry, rz)
    return (
        position[i, 0] + px, position[i, 1] + py, position[i, 2] + pz, rx, ry, rz,
        linear[i, 0] + vx, linear[i, 1] + vy, linear[i, 2] + vz,
    )  # fmt: skip


@inlined
def pull_at(i, fx, fy, fz, rx, ry, rz, inverse_mass, force, torque):
    """Add a force at r from the centre of mass of body i; the world and what stands do not mind."""
    if i < 0 or inverse_mass[i] == 0.0:
        return
    x, y, z = cross(rx, ry, rz, fx, fy, fz)
    force[i, 0] += fx
    force[i, 1] += fy
    force[i, 2] += fz
    torque[i, 0] += x
    torque[i, 1] += y
    torque[i, 2] += z
