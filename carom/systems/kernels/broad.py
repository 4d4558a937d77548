"""Broad phase: where colliders are, and how far they reach within the step."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import CROWD, REACH_FACTOR, REACH_SLACK, REACH_SMALL, REACH_STIRRED, STREAMS
from carom.systems.kernels.flight import offset_of
from carom.systems.kernels.kernel import inlined, kernel, woven
from carom.systems.kernels.lane_columns import (
    SMALLEST,
    give_one,
    give_three,
    in_a_row,
    load_flat,
    load_four,
    load_three,
    store_flat,
    store_four,
    store_one,
    store_three,
    take_four,
    take_one,
    take_three,
)
from carom.systems.kernels.lane_vectors import keep
from carom.systems.kernels.lanes import WIDTH, address, choose, larger, root, smaller, spread, which
from carom.systems.kernels.spatial import product, turn


@kernel("reach", "detected_center", "stream", "gone", makes_arrays=True)
def foresee_reach(
    rows, dt, pull, position, rotation, linear, center_of_mass, inertia, inverse_mass, last_acceleration,
    reach, detected_center, stream, gone,
):  # fmt: skip
    """Say how far each body may travel within ``dt``: its speed and acceleration, or gravity's ``pull`` if greater.

    That is from where the ``stream`` takes it, which begins here, where the one before has ``gone``. Those that are
    struck travel farther. Where many move in it they all are given more: the mean of the ways of all, each up to
    REACH_STIRRED of its least radius of gyration. But small ones are given no more than REACH_SMALL of theirs.
    """
    one, three, four, sums = np.empty(WIDTH), np.empty((WIDTH, 3)), np.empty((WIDTH, 4)), np.empty((3, WIDTH))
    stirred = 0.0
    for k in range(3):
        gone[k] += stream[1, k]
    find_stream(rows, dt, linear, inertia, inverse_mass, stream, one, three, sums)
    sx, sy, sz = spread(stream[0, 0]), spread(stream[0, 1]), spread(stream[0, 2])
    for n in range(0, len(rows), WIDTH):
        near = in_a_row(rows, n)
        x, y, z = take_three(linear, rows, n, near, three)
        x, y, z = x - sx, y - sy, z - sz
        gyration = least_gyration(take_three(inertia, rows, n, near, three), take_one(inverse_mass, rows, n, near, one))
        ways = smaller(root(x * x + y * y + z * z) * dt, REACH_STIRRED * gyration)
        store_one(address(one), 0, (ways,))
        for lane in range(min(WIDTH, len(rows) - n)):
            stirred += one[lane]
    slack = spread(REACH_SLACK + stirred / max(1, len(rows)))
    for n in range(0, len(rows), WIDTH):
        near = in_a_row(rows, n)
        x, y, z = take_three(position, rows, n, near, three)
        ox, oy, oz = offset_of(
            take_four(rotation, rows, n, near, four), take_three(center_of_mass, rows, n, near, three)
        )  # fmt: skip
        give_three(detected_center, rows, n, near, three, (x + ox, y + oy, z + oz))
        gyration = least_gyration(take_three(inertia, rows, n, near, three), take_one(inverse_mass, rows, n, near, one))
        small = REACH_SMALL * gyration
        own = choose(small, smaller(slack, small), slack)
        vx, vy, vz = take_three(linear, rows, n, near, three)
        vx, vy, vz = vx - sx, vy - sy, vz - sz
        ax, ay, az = take_three(last_acceleration, rows, n, near, three)
        speed, push = root(vx * vx + vy * vy + vz * vz), root(ax * ax + ay * ay + az * az)
        give_one(
            reach, rows, n, near, one, own + REACH_FACTOR * (speed + larger(spread(pull), push) * dt) * dt
        )  # fmt: skip


@woven
def find_stream(rows, dt, linear, inertia, inverse_mass, stream, one, three, sums):
    """Write the mean velocity of bodies, or 0 where nothing is gained by it.

    That is where they are few, come no farther than they are large, by their least radii of gyration, or where they
    come about as far as seen from there.
    """
    for k in range(3):
        stream[0, k] = stream[1, k] = 0.0
    if len(rows) < CROWD:
        return
    for i in rows:
        for k in range(3):
            stream[0, k] += linear[i, k]
    for k in range(3):
        stream[0, k] /= len(rows)
    sx, sy, sz = spread(stream[0, 0]), spread(stream[0, 1]), spread(stream[0, 2])
    seen_from_it, ways, sizes = 0.0, 0.0, REACH_SLACK * len(rows)
    for n in range(0, len(rows), WIDTH):
        near = in_a_row(rows, n)
        x, y, z = take_three(linear, rows, n, near, three)
        gyration = least_gyration(take_three(inertia, rows, n, near, three), take_one(inverse_mass, rows, n, near, one))
        dx, dy, dz = x - sx, y - sy, z - sz
        keep(address(sums), 0, root(dx * dx + dy * dy + dz * dz) * dt, root(x * x + y * y + z * z) * dt, gyration)
        for lane in range(min(WIDTH, len(rows) - n)):
            seen_from_it += sums[0, lane]
            ways += sums[1, lane]
            sizes += sums[2, lane]
    if not (ways > sizes and seen_from_it < STREAMS * ways):
        for k in range(3):
            stream[0, k] = 0.0


@woven
def least_gyration(inertia, inverse_mass):
    """Return the least radius of gyration of eight bodies about their axes (m); 0 of who is moved by nothing."""
    return root(smaller(smaller(inertia[0], inertia[1]), inertia[2]) * inverse_mass)


@kernel("pose_position", "pose_rotation", "lower", "upper", "turning", "body_row", "moved")
def place_bounds(
    rows, dt, body, angular, reach, passes, center_of_mass, position, rotation, local_position, local_rotation,
    bound_center, bound_half, bound_radius, pose_position, pose_rotation, lower, upper, turning, body_row, moved,
):  # fmt: skip
    """Place each collider in the world and bound all it can reach: |R| half extents + radius + reach + turning.

    What reaches and turns is its ``body``, a row or -1: that ``passes`` by (m) where others go one way. Turning moves
    no point farther than twice its distance from the centre of mass.
    """
    for n in range(0, len(rows), WIDTH):
        if in_a_row(rows, n) and are_own(rows[n], body, bound_half):
            place_eight(
                rows[n], dt, angular, reach, center_of_mass, position, rotation, local_position, local_rotation,
                bound_center, bound_half, bound_radius, pose_position, pose_rotation, lower, upper, turning, moved,
            )  # fmt: skip
            for i in rows[n : n + WIDTH]:
                body_row[i] = i
            continue
        for i in rows[n : n + WIDTH]:
            body_row[i] = body[i]
            place_one(
                i, dt, body[i], angular, reach, passes, center_of_mass, position, rotation,
                local_position, local_rotation, bound_center, bound_half, bound_radius,
                pose_position, pose_rotation, lower, upper, turning, moved,
            )  # fmt: skip


@woven
def are_own(first, body, bound_half):
    """Tell of eight colliders in a row that each is of the body in its row, and has an end."""
    own = True
    for i in range(first, first + WIDTH):
        own &= body[i] == i and bound_half[i, 0] < np.inf
    return own


@woven
def place_eight(
    i, dt, angular, reach, center_of_mass, position, rotation, local_position, local_rotation,
    bound_center, bound_half, bound_radius, pose_position, pose_rotation, lower, upper, turning, moved,
):  # fmt: skip
    """Place collider i and the seven in the rows behind it, as `place_one` does."""
    q, p = load_four(address(rotation), i), load_three(address(position), i)
    x, y, z = load_three(address(local_position), i)
    x, y, z = turn(q[0], q[1], q[2], q[3], x, y, z)
    place = (p[0] + x, p[1] + y, p[2] + z)
    x, y, z, w = load_four(address(local_rotation), i)
    turned = product(q[0], q[1], q[2], q[3], x, y, z, w)
    before, facing = load_three(address(pose_position), i), load_four(address(pose_rotation), i)
    off = size_of(place[0] - before[0]) + size_of(place[1] - before[1]) + size_of(place[2] - before[2])
    off = off + size_of(turned[0] - facing[0]) + size_of(turned[1] - facing[1])
    stays = which(SMALLEST - (off + size_of(turned[2] - facing[2]) + size_of(turned[3] - facing[3])))
    for lane in range(WIDTH):
        moved[i + lane] = stays >> lane & 1 == 0
    store_three(address(pose_position), i, place)
    store_four(address(pose_rotation), i, turned)
    x, y, z = load_three(address(bound_center), i)
    x, y, z = turn(q[0], q[1], q[2], q[3], x, y, z)
    x, y, z = p[0] + x, p[1] + y, p[2] + z
    wx, wy, wz = load_three(address(angular), i)
    cx, cy, cz = load_three(address(center_of_mass), i)
    hx, hy, hz = load_three(address(bound_half), i)
    away = root((x - cx) * (x - cx) + (y - cy) * (y - cy) + (z - cz) * (z - cz))
    spin = smaller(root(wx * wx + wy * wy + wz * wz) * dt, spread(2.0))
    way = spin * (root(hx * hx + hy * hy + hz * hz) + away)
    store_flat(turning, i, way)
    wide = load_flat(bound_radius, i) + (load_flat(reach, i) + way)
    one, zero = spread(1.0), spread(0.0)
    ax, ay, az = turn(q[0], q[1], q[2], q[3], one, zero, zero)
    bx, by, bz = turn(q[0], q[1], q[2], q[3], zero, one, zero)
    gx, gy, gz = turn(q[0], q[1], q[2], q[3], zero, zero, one)
    half = (
        size_of(ax) * hx + size_of(bx) * hy + size_of(gx) * hz,
        size_of(ay) * hx + size_of(by) * hy + size_of(gy) * hz,
        size_of(az) * hx + size_of(bz) * hy + size_of(gz) * hz,
    )
    store_three(address(lower), i, (x - half[0] - wide, y - half[1] - wide, z - half[2] - wide))
    store_three(address(upper), i, (x + half[0] + wide, y + half[1] + wide, z + half[2] + wide))


@woven
def size_of(x):
    """Return the absolute values of eight numbers."""
    return larger(x, -x)


@inlined
def place_one(
    i, dt, b, angular, reach, passes, center_of_mass, position, rotation, local_position, local_rotation,
    bound_center, bound_half, bound_radius, pose_position, pose_rotation, lower, upper, turning, moved,
):  # fmt: skip
    """Place one collider, of body b."""
    qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
    x, y, z = turn(qx, qy, qz, qw, local_position[i, 0], local_position[i, 1], local_position[i, 2])
    place = (position[i, 0] + x, position[i, 1] + y, position[i, 2] + z)
    turned = product(
        qx, qy, qz, qw, local_rotation[i, 0], local_rotation[i, 1], local_rotation[i, 2], local_rotation[i, 3]
    )
    moved[i] = False
    for k, value in enumerate(place):
        moved[i] |= pose_position[i, k] != value
        pose_position[i, k] = value
    for k, value in enumerate(turned):
        moved[i] |= pose_rotation[i, k] != value
        pose_rotation[i, k] = value
    hx, hy, hz = bound_half[i, 0], bound_half[i, 1], bound_half[i, 2]
    wide = bound_radius[i]
    cx, cy, cz = turn(qx, qy, qz, qw, bound_center[i, 0], bound_center[i, 1], bound_center[i, 2])
    center = (cx, cy, cz)
    if b >= 0:
        spin = sqrt(angular[b, 0] ** 2 + angular[b, 1] ** 2 + angular[b, 2] ** 2)
        away = 0.0
        for k in range(3):
            away += (position[i, k] + center[k] - center_of_mass[b, k]) ** 2
        turning[i] = min(spin * dt, 2.0) * (sqrt(hx * hx + hy * hy + hz * hz) + sqrt(away))
        wide += reach[b] + turning[i]
    else:
        turning[i] = 0.0
        wide += passes
    half = (hx, hy, hz)
    if hx < np.inf:  # a half space has no end whichever way it is turned
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
