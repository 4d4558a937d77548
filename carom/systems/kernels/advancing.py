"""Free motion in lanes: all bodies along their arcs at once."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.spatial.trigonometry import QUARTER_TURN, QUARTER_TURN_REST
from carom.systems.constants import SMALL_ANGLE
from carom.systems.kernels.accounting import KEPT, keep_arc, note_arc
from carom.systems.kernels.bodies import advance_body
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lanes import WIDTH, address, choose, load, root, some, spread, store, whole
from carom.systems.kernels.spatial import product, quarter, series, turn, turned_by

# Rows of the scratch, a lane each body: the time to go, and what moves in it; then what stays.
TIME, CENTER, LINEAR, ANGULAR, TURNED, ROTATION = 0, 1, 4, 7, 10, 13
ACCELERATION, ANGULAR_ACCELERATION, PRINCIPAL, INERTIA, ROWS = 17, 20, 23, 27, 30


@kernel("center", "rotation", "turned", "linear", "angular", "time", "arc", makes_arrays=True)
def advance_bodies(
    rows, now, bend, center, rotation, turned, linear, angular, time, acceleration, angular_acceleration,
    inverse_mass, inertia, principal_axes, freedom, pull, arc,
):  # fmt: skip
    """Bring all bodies that are not there yet along their arcs to ``now``.

    Those that are kinematic or have locked rotations go one by one. An ``arc`` of more than no rows is accounted for.
    """
    scratch, row, kept = np.zeros((ROWS, WIDTH)), np.empty(WIDTH, np.int64), np.empty((WIDTH, KEPT))
    for lane in range(WIDTH):  # what has no body is one that stands still
        scratch[ROTATION + 3, lane] = scratch[PRINCIPAL + 3, lane] = 1.0
    lanes = address(scratch)
    filled = 0
    for number, i in enumerate(rows):
        if time[i] < now:
            if inverse_mass[i] == 0.0 or freedom[i, 3] + freedom[i, 4] + freedom[i, 5] < 3.0:
                t = now - time[i]
                if len(arc):
                    keep_arc(i, filled, kept, center, linear, angular, rotation)
                advance_body(
                    i, now, bend, center, rotation, turned, linear, angular, time, acceleration,
                    angular_acceleration, inverse_mass, inertia, principal_axes, freedom,
                )  # fmt: skip
                if len(arc):
                    note_arc(
                        i, filled, t, bend, kept, center, rotation, linear, angular, acceleration,
                        angular_acceleration, inverse_mass, inertia, principal_axes, pull, arc,
                    )  # fmt: skip
            else:
                if len(arc):
                    keep_arc(i, filled, kept, center, linear, angular, rotation)
                scratch[TIME, filled] = now - time[i]
                time[i] = now
                for k in range(3):
                    scratch[CENTER + k, filled], scratch[LINEAR + k, filled] = center[i, k], linear[i, k]
                    scratch[ANGULAR + k, filled], scratch[TURNED + k, filled] = angular[i, k], turned[i, k]
                    scratch[ACCELERATION + k, filled] = acceleration[i, k]
                    scratch[ANGULAR_ACCELERATION + k, filled] = angular_acceleration[i, k]
                    scratch[INERTIA + k, filled] = inertia[i, k]
                for k in range(4):
                    scratch[ROTATION + k, filled] = rotation[i, k]
                    scratch[PRINCIPAL + k, filled] = principal_axes[i, k]
                row[filled] = i
                filled += 1
        if filled == WIDTH or (filled and number == len(rows) - 1):
            advance(lanes, bend)
            for lane in range(filled):
                j = row[lane]
                for k in range(3):
                    center[j, k], linear[j, k] = scratch[CENTER + k, lane], scratch[LINEAR + k, lane]
                    angular[j, k], turned[j, k] = scratch[ANGULAR + k, lane], scratch[TURNED + k, lane]
                for k in range(4):
                    rotation[j, k] = scratch[ROTATION + k, lane]
                if len(arc):
                    note_arc(
                        j, lane, scratch[TIME, lane], bend, kept, center, rotation, linear, angular, acceleration,
                        angular_acceleration, inverse_mass, inertia, principal_axes, pull, arc,
                    )  # fmt: skip
            filled = 0


@woven
def advance(lanes, bend):
    """Advance the bodies in the lanes: half the turning kick, free rotation, the other half."""
    t = load(lanes, TIME)
    for k in range(3):
        v, a = load(lanes, LINEAR + k), load(lanes, ACCELERATION + k)
        w, b = load(lanes, ANGULAR + k), load(lanes, ANGULAR_ACCELERATION + k)
        store(lanes, CENTER + k, load(lanes, CENTER + k) + (v * t + a * bend * t * t))
        store(lanes, LINEAR + k, v + a * t)
        w = w + b * bend * t
        store(lanes, ANGULAR + k, w)
        store(lanes, TURNED + k, load(lanes, TURNED + k) + w * t)
    wx, wy, wz = load(lanes, ANGULAR), load(lanes, ANGULAR + 1), load(lanes, ANGULAR + 2)
    ix, iy, iz = load(lanes, INERTIA), load(lanes, INERTIA + 1), load(lanes, INERTIA + 2)
    qx, qy, qz, qw = (
        load(lanes, ROTATION), load(lanes, ROTATION + 1), load(lanes, ROTATION + 2), load(lanes, ROTATION + 3)
    )  # fmt: skip
    uneven = (ix - iy) * (ix - iy) + (iy - iz) * (iy - iz)
    uneven = choose(ix * iy * iz, uneven, spread(0.0))
    px, py, pz, pw = qx, qy, qz, qw
    if some(choose(uneven, spread(0.0), t)):
        px, py, pz, pw = spun_in_lanes(qx, qy, qz, qw, wx, wy, wz, t)
    if some(uneven):
        ax, ay, az, aw = (
            load(lanes, PRINCIPAL), load(lanes, PRINCIPAL + 1), load(lanes, PRINCIPAL + 2), load(lanes, PRINCIPAL + 3)
        )  # fmt: skip
        qx, qy, qz, qw = product(qx, qy, qz, qw, ax, ay, az, aw)
        one = spread(1.0)
        ix, iy, iz = choose(uneven, ix, one), choose(uneven, iy, one), choose(uneven, iz, one)
        qx, qy, qz, qw, vx, vy, vz = turned_in_lanes(qx, qy, qz, qw, wx, wy, wz, ix, iy, iz, t)
        qx, qy, qz, qw = product(qx, qy, qz, qw, -ax, -ay, -az, aw)
        px, py, pz, pw = choose(uneven, qx, px), choose(uneven, qy, py), choose(uneven, qz, pz), choose(uneven, qw, pw)
        wx, wy, wz = choose(uneven, vx, wx), choose(uneven, vy, wy), choose(uneven, vz, wz)
    for k, q in enumerate((px, py, pz, pw)):
        store(lanes, ROTATION + k, q)
    for k, w in enumerate((wx, wy, wz)):
        store(lanes, ANGULAR + k, w + load(lanes, ANGULAR_ACCELERATION + k) * (1.0 - bend) * t)


@woven
def spun_in_lanes(qx, qy, qz, qw, wx, wy, wz, t):
    """Return what `spun` does."""
    squared = (wx * wx + wy * wy + wz * wz) * t * t
    small = SMALL_ANGLE * SMALL_ANGLE - squared
    angle = root(choose(small, spread(1.0), squared))
    s, c = sine_cosine_in_lanes(angle * 0.5)
    scale = choose(small, 0.5 * t, s / angle * t)
    x, y, z, w = product(wx * scale, wy * scale, wz * scale, choose(small, spread(1.0), c), qx, qy, qz, qw)
    inverse = 1.0 / root(x * x + y * y + z * z + w * w)
    return x * inverse, y * inverse, z * inverse, w * inverse


@woven
def sine_cosine_in_lanes(angle):
    """Return what `sine_cosine` does."""
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
    lx, ly, lz = turn(-qx, -qy, -qz, qw, wx, wy, wz)
    mx, my, mz = ix * lx, iy * ly, iz * lz
    gx, gy, gz = turn(qx, qy, qz, qw, mx, my, mz)  # angular momentum in the world, which stays
    not_y, not_x = (ix - iy) * (iz - iy), (iy - ix) * (iz - ix)  # which of them is not the middle one
    i, o, middle = middle_last(not_y, not_x, ix, iy, iz)
    mx, my, mz = middle_last(not_y, not_x, mx, my, mz)
    qx, qy, qz, qw = spun_in_lanes(qx, qy, qz, qw, gx / middle, gy / middle, gz / middle, t)
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
    wx, wy, wz = turn(qx, qy, qz, qw, mx / ix, my / iy, mz / iz)
    return qx, qy, qz, qw, wx, wy, wz


@woven
def middle_last(not_y, not_x, x, y, z):
    """Return what is of three axes in a circle, so that what is of the middle one comes last."""
    return (
        choose(not_y, choose(not_x, x, y), z),
        choose(not_y, choose(not_x, y, z), x),
        choose(not_y, choose(not_x, z, x), y),
    )
