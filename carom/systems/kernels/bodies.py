"""What impulses do to bodies, and how bodies move between them; locked axes count here and nowhere else."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import IMMOVABLE
from carom.systems.kernels.freedom import held_turned, inverse_inertia_of
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.spatial import cross, freely_turned, inverse_inertia_times, product, spun


@woven
def length_of(i, vectors):
    """Return how long the vector of body i is; of none, 0."""
    return 0.0 if i < 0 else sqrt(vectors[i, 0] ** 2 + vectors[i, 1] ** 2 + vectors[i, 2] ** 2)


@inlined
def surface_velocity(i, rx, ry, rz, linear, angular):
    """Return the velocity of the point at r from the centre of body i, zero for a static one."""
    if i < 0:
        return 0.0, 0.0, 0.0
    x, y, z = cross(angular[i, 0], angular[i, 1], angular[i, 2], rx, ry, rz)
    return linear[i, 0] + x, linear[i, 1] + y, linear[i, 2] + z


@inlined
def push_at(
    i, sign, jx, jy, jz, rx, ry, rz, linear, angular, inverse_mass, inverse_inertia, principal, freedom, rotation
):
    """Apply an impulse times ``sign`` at r from the centre of body i."""
    if i < 0:
        return
    m = sign * inverse_mass[i]
    linear[i, 0] += m * freedom[i, 0] * jx
    linear[i, 1] += m * freedom[i, 1] * jy
    linear[i, 2] += m * freedom[i, 2] * jz
    tx, ty, tz = cross(rx, ry, rz, jx, jy, jz)
    turn_at(i, sign, tx, ty, tz, angular, inverse_inertia, principal, freedom, rotation)


@inlined
def turn_at(i, sign, tx, ty, tz, angular, inverse_inertia, principal, freedom, rotation):
    """Apply an angular impulse times ``sign`` to body i."""
    if i < 0:
        return
    wx, wy, wz = turned_by(i, tx, ty, tz, inverse_inertia, principal, freedom, rotation)
    angular[i, 0] += sign * wx
    angular[i, 1] += sign * wy
    angular[i, 2] += sign * wz


@inlined
def turned_by(i, tx, ty, tz, inverse_inertia, principal, freedom, rotation):
    """Return I^-1 t of body i in the world frame."""
    ix, iy, iz = inverse_inertia[i, 0], inverse_inertia[i, 1], inverse_inertia[i, 2]
    fx, fy, fz = freedom[i, 3], freedom[i, 4], freedom[i, 5]
    if ix == iy and iy == iz:
        return fx * ix * tx, fy * ix * ty, fz * ix * tz
    if fx + fy + fz == 3.0:
        qx, qy, qz, qw = product(
            rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3],
            principal[i, 0], principal[i, 1], principal[i, 2], principal[i, 3],
        )  # fmt: skip
        return inverse_inertia_times(qx, qy, qz, qw, ix, iy, iz, tx, ty, tz)
    xx, xy, xz, yy, yz, zz = inverse_inertia_of(i, inverse_inertia, principal, freedom, rotation)
    return xx * tx + xy * ty + xz * tz, xy * tx + yy * ty + yz * tz, xz * tx + yz * ty + zz * tz


@inlined
def inverse_mass_along(i, nx, ny, nz, inverse_mass, freedom):
    """Return how fast the centre of body i moves along a unit vector by a unit impulse along it."""
    if freedom[i, 0] + freedom[i, 1] + freedom[i, 2] == 3.0:
        return inverse_mass[i]
    return inverse_mass[i] * (nx * nx * freedom[i, 0] + ny * ny * freedom[i, 1] + nz * nz * freedom[i, 2])


@inlined
def hardness(yields, a, b, inverse_mass):
    """Return 1 / yields: which impulse parts two bodies by 1 m/s along a direction; 0 where locks all but forbid it."""
    return 1.0 / yields if yields > IMMOVABLE * movable_of(a, b, inverse_mass) else 0.0


@inlined
def movable_of(a, b, inverse_mass):
    """Return the inverse mass of two bodies against each other; -1 is none."""
    return (inverse_mass[a] if a >= 0 else 0.0) + (inverse_mass[b] if b >= 0 else 0.0)


@woven
def is_on_joint(i, on_joint):
    """Tell whether body i, or nobody, is ``on_joint``, which has no rows where there are no joints."""
    return 0 <= i < len(on_joint) and on_joint[i]


@inlined
def pressing_of(i, o, nx, ny, nz, acceleration):
    """Return how fast two bodies accelerate towards each other along the normal n from o to i."""
    pressing = -(nx * acceleration[i, 0] + ny * acceleration[i, 1] + nz * acceleration[i, 2])
    if o >= 0:
        pressing += nx * acceleration[o, 0] + ny * acceleration[o, 1] + nz * acceleration[o, 2]
    return pressing


@inlined
def stop_pressing(i, o, nx, ny, nz, inverse_mass, freedom, acceleration):
    """Take out of two arcs the acceleration by which the bodies press on each other, as a contact force would."""
    pressing = pressing_of(i, o, nx, ny, nz, acceleration)
    total = inverse_mass_along(i, nx, ny, nz, inverse_mass, freedom)
    if o >= 0:
        total += inverse_mass_along(o, nx, ny, nz, inverse_mass, freedom)
    if pressing <= 0.0 or hardness(total, i, o, inverse_mass) == 0.0:
        return False
    for k, n in enumerate((nx, ny, nz)):
        acceleration[i, k] += pressing * inverse_mass[i] / total * n * freedom[i, k]
        if o >= 0:
            acceleration[o, k] -= pressing * inverse_mass[o] / total * n * freedom[o, k]
    return True


@woven
def advance_body(
    i, now, bend, center, rotation, turned, linear, angular, time, acceleration, angular_acceleration,
    inverse_mass, inertia, principal_axes, freedom,
):  # fmt: skip
    """Bring one body along its arc to ``now``: half the turning kick, free rotation, the other half.

    A kinematic body keeps its angular velocity, whatever its moments are.
    """
    t = now - time[i]
    for k in range(3):
        center[i, k] += linear[i, k] * t + bend * acceleration[i, k] * t * t
        linear[i, k] += acceleration[i, k] * t
        angular[i, k] += bend * angular_acceleration[i, k] * t
        turned[i, k] += angular[i, k] * t
    time[i] = now
    qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
    if inverse_mass[i] == 0.0:
        rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3] = spun(
            qx, qy, qz, qw, angular[i, 0], angular[i, 1], angular[i, 2], t
        )
        return
    ax, ay, az, aw = principal_axes[i, 0], principal_axes[i, 1], principal_axes[i, 2], principal_axes[i, 3]
    wx, wy, wz = angular[i, 0], angular[i, 1], angular[i, 2]
    ix, iy, iz = inertia[i, 0], inertia[i, 1], inertia[i, 2]
    if freedom[i, 3] + freedom[i, 4] + freedom[i, 5] < 3.0:
        rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3], wx, wy, wz = held_turned(
            qx, qy, qz, qw, ax, ay, az, aw, wx, wy, wz, ix, iy, iz, freedom[i, 3], freedom[i, 4], freedom[i, 5], t
        )  # fmt: skip
    else:
        qx, qy, qz, qw = product(qx, qy, qz, qw, ax, ay, az, aw)
        qx, qy, qz, qw, wx, wy, wz = freely_turned(qx, qy, qz, qw, wx, wy, wz, ix, iy, iz, t)
        rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3] = product(qx, qy, qz, qw, -ax, -ay, -az, aw)
    turned[i, 0] += 0.5 * (wx - angular[i, 0]) * t  # as fast as in the middle of the way
    turned[i, 1] += 0.5 * (wy - angular[i, 1]) * t
    turned[i, 2] += 0.5 * (wz - angular[i, 2]) * t
    angular[i, 0] = wx + (1.0 - bend) * angular_acceleration[i, 0] * t
    angular[i, 1] = wy + (1.0 - bend) * angular_acceleration[i, 1] * t
    angular[i, 2] = wz + (1.0 - bend) * angular_acceleration[i, 2] * t
