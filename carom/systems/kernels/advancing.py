"""Free motion in lanes: all bodies along their arcs at once."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.spatial.trigonometry import EIGHTH_SQUARED, QUARTER_TURN, QUARTER_TURN_REST
from carom.systems.kernels.accounting import KEPT, keep_arc, note_arc
from carom.systems.kernels.bodies import advance_body
from carom.systems.kernels.crew import eights_of
from carom.systems.kernels.kernel import making, woven
from carom.systems.kernels.lane_columns import (
    are_all,
    give_four,
    give_one,
    give_three,
    in_a_row,
    load_flat,
    store_flat,
    take_four,
    take_one,
    take_three,
)
from carom.systems.kernels.lanes import WIDTH, choose, larger, root, some, spread, whole
from carom.systems.kernels.spatial import even_series, product, quarter, series, turn, turned_by


@making
def advance_bodies(
    crew, rows, now, bend, center, rotation, turned, linear, angular, time, acceleration, angular_acceleration,
    inverse_mass, inertia, principal_axes, freedom, pull, arc,
):  # fmt: skip
    """Bring all bodies that are not there yet along their arcs to ``now``.

    Eight go side by side, unless one of them is there, is kinematic or has locked rotations. An ``arc`` of more than no
    rows is accounted for.
    """
    kept, took = np.empty((WIDTH, KEPT)), np.empty(WIDTH)
    one, three, four = np.empty(WIDTH), np.empty((WIDTH, 3)), np.empty((WIDTH, 4))
    begin, end = eights_of(crew, len(rows))
    rows = rows[begin:end]
    for n in range(0, len(rows), WIDTH):
        near = in_a_row(rows, n)
        together = near and set_out_together(rows[n], now, time, inverse_mass, freedom)
        alike = together or are_alike(rows, n, now, time, inverse_mass, freedom)
        if len(arc):
            for lane, i in enumerate(rows[n : n + WIDTH]):
                took[lane] = now - time[i]
                keep_arc(i, lane, kept, center, linear, angular, rotation)
        if together:
            fly_together(
                rows[n], now - time[rows[n]], bend, center, turned, linear, angular, acceleration, angular_acceleration
            )  # fmt: skip
        elif alike:
            fly_eight(
                n, now, bend, near, one, three, rows, center, turned, linear, angular, time, acceleration,
                angular_acceleration,
            )  # fmt: skip
        if alike:
            turn_eight(
                n, now, bend, near, one, three, four, rows, rotation, turned, angular, time, angular_acceleration,
                inertia, principal_axes,
            )  # fmt: skip
        else:
            for i in rows[n : n + WIDTH]:
                if time[i] < now:
                    advance_body(
                        i, now, bend, center, rotation, turned, linear, angular, time, acceleration,
                        angular_acceleration, inverse_mass, inertia, principal_axes, freedom,
                    )  # fmt: skip
        if len(arc):
            for lane, i in enumerate(rows[n : n + WIDTH]):
                if took[lane] > 0.0:
                    note_arc(
                        i, lane, took[lane], bend, kept, center, rotation, linear, angular, acceleration,
                        angular_acceleration, inverse_mass, inertia, principal_axes, pull, arc,
                    )  # fmt: skip


@woven
def set_out_together(i, now, time, inverse_mass, freedom):
    """Tell of body i and the seven in the rows behind it that all are free and fly from one time on to ``now``."""
    kinematic = choose(load_flat(inverse_mass, i), spread(0.0), spread(1.0))
    return time[i] < now and are_all(time[i], time, 1, i) and are_all(1.0, freedom, 6, i) and not some(kinematic)


@woven
def are_alike(rows, n, now, time, inverse_mass, freedom):
    """Tell of eight rows from the n-th on that no body is there yet, kinematic or has locked rotations."""
    alike = True
    for k in range(n, min(n + WIDTH, len(rows))):
        i = rows[k]
        alike &= freedom[i, 3] + freedom[i, 4] + freedom[i, 5] == 3.0 and inverse_mass[i] != 0.0 and time[i] < now
    return alike


@woven
def fly_together(i, t, bend, center, turned, linear, angular, acceleration, angular_acceleration):
    """Bring body i and the seven in the rows behind it along their arcs, t seconds, and sum what they turn by."""
    for at in range(3 * i, 3 * (i + WIDTH), WIDTH):
        v, a = load_flat(linear, at), load_flat(acceleration, at)
        store_flat(center, at, load_flat(center, at) + (v * t + a * bend * t * t))
        store_flat(linear, at, v + a * t)
        w = load_flat(angular, at) + load_flat(angular_acceleration, at) * bend * t
        store_flat(turned, at, load_flat(turned, at) + w * t)


@woven
def fly_eight(
    n, now, bend, near, one, three, rows, center, turned, linear, angular, time, acceleration, angular_acceleration
):  # fmt: skip
    """Bring the bodies of eight rows along their arcs, each from its own time on, and sum what they turn by."""
    t = now - take_one(time, rows, n, near, one)
    v, a = take_three(linear, rows, n, near, three), take_three(acceleration, rows, n, near, three)
    x, y, z = take_three(center, rows, n, near, three)
    x, y, z = (
        x + (v[0] * t + a[0] * bend * t * t),
        y + (v[1] * t + a[1] * bend * t * t),
        z + (v[2] * t + a[2] * bend * t * t),
    )
    give_three(center, rows, n, near, three, (x, y, z))
    give_three(linear, rows, n, near, three, (v[0] + a[0] * t, v[1] + a[1] * t, v[2] + a[2] * t))
    w, b = take_three(angular, rows, n, near, three), take_three(angular_acceleration, rows, n, near, three)
    x, y, z = take_three(turned, rows, n, near, three)
    w = (w[0] + b[0] * bend * t, w[1] + b[1] * bend * t, w[2] + b[2] * bend * t)
    give_three(turned, rows, n, near, three, (x + w[0] * t, y + w[1] * t, z + w[2] * t))


@woven
def turn_eight(
    n, now, bend, near, one, three, four, rows, rotation, turned, angular, time, angular_acceleration, inertia,
    principal_axes,
):  # fmt: skip
    """Turn the bodies of eight rows as `advance_body` does: half the turning kick, free rotation, the other half."""
    t = now - take_one(time, rows, n, near, one)
    w, b = take_three(angular, rows, n, near, three), take_three(angular_acceleration, rows, n, near, three)
    wx, wy, wz = w[0] + b[0] * bend * t, w[1] + b[1] * bend * t, w[2] + b[2] * bend * t
    qx, qy, qz, qw = take_four(rotation, rows, n, near, four)
    ix, iy, iz = take_three(inertia, rows, n, near, three)
    uneven = (ix - iy) * (ix - iy) + (iy - iz) * (iy - iz)
    uneven = choose(ix * iy * iz, uneven, spread(0.0))
    px, py, pz, pw = qx, qy, qz, qw
    if some(choose(uneven, spread(0.0), t)):
        px, py, pz, pw = spun_in_lanes(qx, qy, qz, qw, wx, wy, wz, t)
    if some(uneven):
        ax, ay, az, aw = take_four(principal_axes, rows, n, near, four)
        aside = some(ax * ax + ay * ay + az * az)  # seldom: most bodies turn about axes of their own frame
        if aside:
            qx, qy, qz, qw = product(qx, qy, qz, qw, ax, ay, az, aw)
        unit = spread(1.0)
        ix, iy, iz = choose(uneven, ix, unit), choose(uneven, iy, unit), choose(uneven, iz, unit)
        qx, qy, qz, qw, vx, vy, vz = turned_in_lanes(qx, qy, qz, qw, wx, wy, wz, ix, iy, iz, t)
        if aside:
            qx, qy, qz, qw = product(qx, qy, qz, qw, -ax, -ay, -az, aw)
        px, py, pz, pw = choose(uneven, qx, px), choose(uneven, qy, py), choose(uneven, qz, pz), choose(uneven, qw, pw)
        vx, vy, vz = choose(uneven, vx, wx), choose(uneven, vy, wy), choose(uneven, vz, wz)
        x, y, z = take_three(turned, rows, n, near, three)
        x, y, z = x + 0.5 * (vx - wx) * t, y + 0.5 * (vy - wy) * t, z + 0.5 * (vz - wz) * t
        give_three(turned, rows, n, near, three, (x, y, z))  # as fast as in the middle of the way
        wx, wy, wz = vx, vy, vz
    give_four(rotation, rows, n, near, four, (px, py, pz, pw))
    rest = 1.0 - bend
    w = (wx + b[0] * rest * t, wy + b[1] * rest * t, wz + b[2] * rest * t)
    give_three(angular, rows, n, near, three, w)
    give_one(time, rows, n, near, one, spread(now))


@woven
def spun_in_lanes(qx, qy, qz, qw, wx, wy, wz, t):
    """Return what `spun` does."""
    x, y, z, w = spinning_in_lanes(qx, qy, qz, qw, wx, wy, wz, t)
    inverse = 1.0 / root(x * x + y * y + z * z + w * w)
    return x * inverse, y * inverse, z * inverse, w * inverse


@woven
def spinning_in_lanes(qx, qy, qz, qw, wx, wy, wz, t):
    """Return what `spinning` does."""
    squared = 0.25 * ((wx * wx + wy * wy + wz * wz) * t * t)
    s, c = even_series(squared)
    scale, large = 0.5 * t * (1.0 + squared * s), squared - EIGHTH_SQUARED
    if some(large):
        half = root(choose(large, squared, spread(1.0)))
        s, cosine = sine_cosine_in_lanes(half)
        scale, c = choose(large, 0.5 * t * (s / half), scale), choose(large, cosine, c)
    return product(wx * scale, wy * scale, wz * scale, c, qx, qy, qz, qw)


@woven
def sine_cosine_in_lanes(angle):
    """Return what `sine_cosine` does; where no angle is of another quadrant, none is looked for."""
    if not some(larger(angle, -angle) - 0.5 * QUARTER_TURN):
        return series(angle)
    turns = whole(angle / QUARTER_TURN + 0.5)
    x = (angle - turns * QUARTER_TURN) - turns * QUARTER_TURN_REST
    s, c = series(x)
    quadrant = turns - 4.0 * whole(turns / 4.0)
    odd, second = quadrant - 2.0 * whole(quadrant / 2.0), quadrant - 1.5
    sine, cosine = choose(odd, c, s), choose(odd, -s, c)
    return choose(second, -sine, sine), choose(second, -cosine, cosine)


turned_twice = turned_by(sine_cosine_in_lanes)


@woven
def turned_in_lanes(qx, qy, qz, qw, wx, wy, wz, ix, iy, iz, t):
    """Return what `freely_turned` does for bodies whose three moments are not one and none of them 0."""
    jx, jy, jz = 1.0 / ix, 1.0 / iy, 1.0 / iz
    lx, ly, lz = turn(-qx, -qy, -qz, qw, wx, wy, wz)
    mx, my, mz = ix * lx, iy * ly, iz * lz
    gx, gy, gz = turn(qx, qy, qz, qw, mx, my, mz)  # angular momentum in the world, which stays
    not_y, not_x = (ix - iy) * (iz - iy), (iy - ix) * (iz - ix)  # which of them is not the middle one
    i, o, middle = middle_last(not_y, not_x, jx, jy, jz)
    mx, my, mz = middle_last(not_y, not_x, mx, my, mz)
    qx, qy, qz, qw = spinning_in_lanes(qx, qy, qz, qw, gx * middle, gy * middle, gz * middle, t)
    qx, qy, qz = middle_last(not_y, not_x, qx, qy, qz)
    qx, qy, qz, qw = turned_twice(qx, qy, qz, qw, mx, my, mz, quarter(t, i, middle), quarter(t, o, middle))
    qx, qy, qz = (
        choose(not_y, choose(not_x, qx, qz), qy),
        choose(not_y, choose(not_x, qy, qx), qz),
        choose(not_y, choose(not_x, qz, qy), qx),
    )
    inverse = 1.0 / root(qx * qx + qy * qy + qz * qz + qw * qw)
    qx, qy, qz, qw = qx * inverse, qy * inverse, qz * inverse, qw * inverse
    mx, my, mz = turn(-qx, -qy, -qz, qw, gx, gy, gz)
    wx, wy, wz = turn(qx, qy, qz, qw, mx * jx, my * jy, mz * jz)
    return qx, qy, qz, qw, wx, wy, wz


@woven
def middle_last(not_y, not_x, x, y, z):
    """Return what is of three axes in a circle, so that what is of the middle one comes last."""
    return (
        choose(not_y, choose(not_x, x, y), z),
        choose(not_y, choose(not_x, y, z), x),
        choose(not_y, choose(not_x, z, x), y),
    )
