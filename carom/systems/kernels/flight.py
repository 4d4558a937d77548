"""Kernels of free motion: arcs that begin, prediction to the middle of the substep, acceleration."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.systems.kernels.bodies import turned_by
from carom.systems.kernels.crew import eights_of, shared
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lane_columns import (
    are_all,
    give_four,
    give_one,
    give_three,
    in_a_row,
    load_flat,
    set_all,
    store_flat,
    take_four,
    take_freedom,
    take_one,
    take_three,
)
from carom.systems.kernels.lanes import WIDTH, choose, larger, root, some, spread
from carom.systems.kernels.spatial import product, turn


@shared(
    "position", "rotation", "linear", "angular",
    "center", "start_center", "start_position", "start_rotation", "start_linear", "start_angular",
    "angular_acceleration", "time", "turned", "touching",
    makes_arrays=True,
)  # fmt: skip
def predict_middle(
    crew, rows, half, center_of_mass, freedom, held, last_acceleration, last_angular_acceleration,
    position, rotation, linear, angular,
    center, start_center, start_position, start_rotation, start_linear, start_angular,
    angular_acceleration, time, turned, touching,
):  # fmt: skip
    """Begin the arcs of bodies: save where they are; move them ``half`` seconds on, for forces to be evaluated there.

    Along and about locked axes they are at rest, whatever velocity was set from outside.
    The middle velocity uses the acceleration of the substep before, which keeps velocity Verlet of second order also
    with forces that depend on velocity.
    """
    one, three, four, six = np.empty(WIDTH), np.empty((WIDTH, 3)), np.empty((WIDTH, 4)), np.empty((WIDTH, 6))
    zero = spread(0.0)
    begin, end = eights_of(crew, len(rows))
    rows = rows[begin:end]
    for n in range(0, len(rows), WIDTH):
        near = in_a_row(rows, n)
        for i in rows[n : n + WIDTH]:
            touching[i] = held[i]
        if near and half == 0.0 and are_all(0.0, center_of_mass, 3, rows[n]) and are_all(1.0, freedom, 6, rows[n]):
            begin_eight(
                rows[n], position, rotation, linear, angular, center, start_center, start_position, start_rotation,
                start_linear, start_angular, angular_acceleration, time, turned,
            )  # fmt: skip
            continue
        q, c = take_four(rotation, rows, n, near, four), take_three(center_of_mass, rows, n, near, three)
        free = take_freedom(freedom, rows, n, near, six)
        v, w = take_three(linear, rows, n, near, three), take_three(angular, rows, n, near, three)
        v = (choose(free[0], v[0], zero), choose(free[1], v[1], zero), choose(free[2], v[2], zero))
        w = (choose(free[3], w[0], zero), choose(free[4], w[1], zero), choose(free[5], w[2], zero))
        x, y, z = take_three(position, rows, n, near, three)
        give_three(start_position, rows, n, near, three, (x, y, z))
        give_four(start_rotation, rows, n, near, four, q)
        give_three(start_linear, rows, n, near, three, v)
        give_three(start_angular, rows, n, near, three, w)
        ox, oy, oz = offset_of(q, c)
        x, y, z = x + ox, y + oy, z + oz
        give_three(center, rows, n, near, three, (x, y, z))
        give_three(start_center, rows, n, near, three, (x, y, z))
        if half != 0.0:
            # Straight on and back to length 1, which is a turn up to the third order.
            by = 0.5 * half
            nx, ny, nz, nw = product(by * w[0], by * w[1], by * w[2], 1.0, q[0], q[1], q[2], q[3])
            inverse = 1.0 / root(nx * nx + ny * ny + nz * nz + nw * nw)
            q = (nx * inverse, ny * inverse, nz * inverse, nw * inverse)
            give_four(rotation, rows, n, near, four, q)
            ox, oy, oz = offset_of(q, c)
            x, y, z = x + half * v[0] - ox, y + half * v[1] - oy, z + half * v[2] - oz
            give_three(position, rows, n, near, three, (x, y, z))
            a = take_three(last_acceleration, rows, n, near, three)
            b = take_three(last_angular_acceleration, rows, n, near, three)
            v = (v[0] + half * a[0], v[1] + half * a[1], v[2] + half * a[2])
            w = (w[0] + half * b[0], w[1] + half * b[1], w[2] + half * b[2])
        give_three(linear, rows, n, near, three, v)
        give_three(angular, rows, n, near, three, w)
        give_three(angular_acceleration, rows, n, near, three, (zero, zero, zero))
        give_three(turned, rows, n, near, three, (zero, zero, zero))
        give_one(time, rows, n, near, one, zero)


@woven
def begin_eight(
    i, position, rotation, linear, angular, center, start_center, start_position, start_rotation,
    start_linear, start_angular, angular_acceleration, time, turned,
):  # fmt: skip
    """Begin the arcs of body i and the seven in the rows behind it, free ones about their origins, where they are."""
    zero = spread(0.0)
    for at in range(3 * i, 3 * (i + WIDTH), WIDTH):
        x = load_flat(position, at)
        store_flat(center, at, x)
        store_flat(start_center, at, x)
        store_flat(start_position, at, x)
        store_flat(start_linear, at, load_flat(linear, at))
        store_flat(start_angular, at, load_flat(angular, at))
        store_flat(turned, at, zero)
    set_all(0.0, angular_acceleration, 3, i)
    for at in range(4 * i, 4 * (i + WIDTH), WIDTH):
        store_flat(start_rotation, at, load_flat(rotation, at))
    store_flat(time, i, zero)


@woven
def offset_of(q, center_of_mass):
    """Return where centres of mass are from the origins of eight bodies turned to q, in the world frame."""
    x, y, z = center_of_mass
    zero = spread(0.0)
    off = larger(larger(larger(x, -x), larger(y, -y)), larger(z, -z))
    if not some(off):
        return zero, zero, zero
    x, y, z = turn(q[0], q[1], q[2], q[3], x, y, z)
    return choose(off, x, zero), choose(off, y, zero), choose(off, z, zero)


@kernel("position", "rotation", "linear", "angular", "felt", "angular_acceleration", makes_arrays=True)
def accelerate(
    rows, moved, inverse_mass, inverse_inertia, principal_axes, freedom, force, torque, external_force, external_torque,
    start_position, start_rotation, start_linear, start_angular,
    position, rotation, linear, angular, felt, angular_acceleration,
):  # fmt: skip
    """Turn forces into accelerations, and bring bodies that were ``moved`` on back to the start of the substep."""
    one, three, four, six = np.empty(WIDTH), np.empty((WIDTH, 3)), np.empty((WIDTH, 4)), np.empty((WIDTH, 6))
    for n in range(0, len(rows), WIDTH):
        near = in_a_row(rows, n)
        x, y, z = take_three(torque, rows, n, near, three)
        ex, ey, ez = take_three(external_torque, rows, n, near, three)
        x, y, z = x + ex, y + ey, z + ez
        give_three(angular_acceleration, rows, n, near, three, (x, y, z))
        if some(larger(larger(larger(x, -x), larger(y, -y)), larger(z, -z))):
            for i in rows[n : n + WIDTH]:
                ax, ay, az = angular_acceleration[i, 0], angular_acceleration[i, 1], angular_acceleration[i, 2]
                if ax != 0.0 or ay != 0.0 or az != 0.0:
                    ax, ay, az = turned_by(i, ax, ay, az, inverse_inertia, principal_axes, freedom, rotation)
                angular_acceleration[i, 0], angular_acceleration[i, 1], angular_acceleration[i, 2] = ax, ay, az
        f, e = take_three(force, rows, n, near, three), take_three(external_force, rows, n, near, three)
        m, free = take_one(inverse_mass, rows, n, near, one), take_freedom(freedom, rows, n, near, six)
        x, y, z = (f[0] + e[0]) * m * free[0], (f[1] + e[1]) * m * free[1], (f[2] + e[2]) * m * free[2]
        give_three(felt, rows, n, near, three, (x, y, z))
        if moved:
            give_three(position, rows, n, near, three, take_three(start_position, rows, n, near, three))
            give_four(rotation, rows, n, near, four, take_four(start_rotation, rows, n, near, four))
            give_three(linear, rows, n, near, three, take_three(start_linear, rows, n, near, three))
            give_three(angular, rows, n, near, three, take_three(start_angular, rows, n, near, three))


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
