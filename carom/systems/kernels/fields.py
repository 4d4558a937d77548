"""Kernels of fields: points that attract, wings, spin, thrust, vortices."""

from __future__ import annotations

from math import pi, sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.spatial import cross, turn


@inlined
def from_point(i, x, y, z, center_of_mass, position, rotation):
    """Return where the centre of mass of body i is from a point."""
    ox, oy, oz = turn(
        rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3],
        center_of_mass[i, 0], center_of_mass[i, 1], center_of_mass[i, 2],
    )  # fmt: skip
    return position[i, 0] + ox - x, position[i, 1] + oy - y, position[i, 2] + oz - z


@kernel("force")
def add_well(rows, strength, x, y, z, radius, mass, center_of_mass, position, rotation, force):
    """Add G M m / r^2 towards a point, within the radius G M m r / R^3."""
    for i in rows:
        dx, dy, dz = from_point(i, x, y, z, center_of_mass, position, rotation)
        distance = max(sqrt(dx * dx + dy * dy + dz * dz), radius)
        if distance == 0.0:
            continue
        pull = strength * mass[i] / (distance * distance * distance)
        for k, d in enumerate((dx, dy, dz)):
            force[i, k] -= pull * d


@kernel("force")
def add_central(rows, strength, power, x, y, z, center_of_mass, position, rotation, force):
    """Add k r^n towards a point, n whole."""
    for i in rows:
        dx, dy, dz = from_point(i, x, y, z, center_of_mass, position, rotation)
        distance = sqrt(dx * dx + dy * dy + dz * dz)
        if distance == 0.0:
            continue
        pull = strength
        for _ in range(abs(power)):
            pull = pull * distance if power > 0 else pull / distance
        for k, d in enumerate((dx, dy, dz)):
            force[i, k] -= pull * d / distance


@kernel("force")
def add_lift(rows, factor, sx, sy, sz, rotation, linear, medium, force):
    """Add ``factor`` (kg/m) times |u| (s x u), u the velocity through the medium, s the unit vector of the span."""
    size = sqrt(sx * sx + sy * sy + sz * sz)
    for i in rows:
        x, y, z = turn(rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3], sx / size, sy / size, sz / size)
        ux, uy, uz = linear[i, 0] - medium[i, 0], linear[i, 1] - medium[i, 1], linear[i, 2] - medium[i, 2]
        pull = factor * sqrt(ux * ux + uy * uy + uz * uz)
        for k, across in enumerate(cross(x, y, z, ux, uy, uz)):
            force[i, k] += pull * across


@kernel("force")
def add_magnus(rows, factor, linear, angular, medium, force):
    """Add ``factor`` (kg) times w x u, u the velocity through the medium."""
    for i in rows:
        ux, uy, uz = linear[i, 0] - medium[i, 0], linear[i, 1] - medium[i, 1], linear[i, 2] - medium[i, 2]
        for k, across in enumerate(cross(angular[i, 0], angular[i, 1], angular[i, 2], ux, uy, uz)):
            force[i, k] += factor * across


@kernel("force", "torque")
def add_thrust(rows, fx, fy, fz, x, y, z, center_of_mass, rotation, force, torque):
    """Add a force that is fixed to the body at a point of it, and its torque."""
    for i in rows:
        qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
        ux, uy, uz = turn(qx, qy, qz, qw, fx, fy, fz)
        rx, ry, rz = turn(qx, qy, qz, qw, x - center_of_mass[i, 0], y - center_of_mass[i, 1], z - center_of_mass[i, 2])
        for k, (push, twist) in enumerate(zip((ux, uy, uz), cross(rx, ry, rz, ux, uy, uz))):  # noqa: B905
            force[i, k] += push
            torque[i, k] += twist


@kernel("medium")
def add_vortex(rows, circulation, core, rise, x, y, z, ax, ay, az, position, medium):
    """Add the velocity of a vortex, C / (2 pi r) about its axis and that of a solid within the core."""
    size = sqrt(ax * ax + ay * ay + az * az)
    ax, ay, az = ax / size, ay / size, az / size
    for i in rows:
        dx, dy, dz = position[i, 0] - x, position[i, 1] - y, position[i, 2] - z
        vx, vy, vz = cross(ax, ay, az, dx, dy, dz)
        away = sqrt(vx * vx + vy * vy + vz * vz)  # from the axis
        inside = away < core
        rate = circulation / (2.0 * pi * (core * core if inside else away * away))
        up = rise if inside else 0.0
        medium[i, 0] += rate * vx + up * ax
        medium[i, 1] += rate * vy + up * ay
        medium[i, 2] += rate * vz + up * az
