"""Impacts: bodies fly along their arcs to the end of the substep, reflected at the exact time of every impact."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import (
    APPROACH,
    BLOW_SPEED_FACTOR,
    IMPACTS_AT_LEAST,
    IMPACTS_PER_PAIR,
    REST_SPEED_FACTOR,
    TOUCH,
)
from carom.systems.kernels.balls import BALL, NEVER, first_touch, gap_of_ball
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.spatial import cross, freely_turned, inverse_inertia_times, product, spun

DONE, OUT_OF_REACH, TABLE_FULL = 0, 1, 2


@inlined
def struck(vn, sx, sy, sz, nx, ny, nz, k, restitution, friction):
    """Return the impulse (3) on the second body for closing velocity s with normal part vn < 0 at inverse mass k (3x3).

    Newton's restitution along the normal; the tangential part stops sliding if Coulomb's cone allows it, and else
    slides at the cone's edge (Mirtich, Impulse-based Dynamic Simulation, 1996, section 3.2, for two-stage impact laws).
    """
    kxx, kxy, kxz, kyy, kyz, kzz = k
    knx, kny, knz = kxx * nx + kxy * ny + kxz * nz, kxy * nx + kyy * ny + kyz * nz, kxz * nx + kyz * ny + kzz * nz
    knn = nx * knx + ny * kny + nz * knz
    tx, ty, tz = sx - vn * nx, sy - vn * ny, sz - vn * nz
    sliding = sqrt(tx * tx + ty * ty + tz * tz)
    wanted = -(1.0 + restitution) * vn
    if friction == 0.0 or sliding <= APPROACH:
        normal = wanted / knn
        return normal * nx, normal * ny, normal * nz, normal
    # Stick: solve K j = (wanted n - t) by Cramer's rule.
    rx, ry, rz = wanted * nx - tx, wanted * ny - ty, wanted * nz - tz
    cxx, cxy, cxz = kyy * kzz - kyz * kyz, kxz * kyz - kxy * kzz, kxy * kyz - kxz * kyy
    cyy, cyz, czz = kxx * kzz - kxz * kxz, kxy * kxz - kxx * kyz, kxx * kyy - kxy * kxy
    determinant = kxx * cxx + kxy * cxy + kxz * cxz
    jx = (cxx * rx + cxy * ry + cxz * rz) / determinant
    jy = (cxy * rx + cyy * ry + cyz * rz) / determinant
    jz = (cxz * rx + cyz * ry + czz * rz) / determinant
    normal = jx * nx + jy * ny + jz * nz
    fx, fy, fz = jx - normal * nx, jy - normal * ny, jz - normal * nz
    if normal > 0.0 and fx * fx + fy * fy + fz * fz <= friction * friction * normal * normal:
        return jx, jy, jz, normal
    tx, ty, tz = tx / sliding, ty / sliding, tz / sliding
    normal = wanted / (knn - friction * (tx * knx + ty * kny + tz * knz))
    if normal <= 0.0:  # jamming: friction alone would stop the approach
        normal = wanted / knn
        return normal * nx, normal * ny, normal * nz, normal
    edge = friction * normal
    return normal * nx - edge * tx, normal * ny - edge * ty, normal * nz - edge * tz, normal


@kernel(
    "center", "rotation", "linear", "angular", "time", "acceleration", "resting", "impulse", "friction_impulse",
    "log_time", "log_pair", "log_point", "log_normal", "log_speed", "log_impulse", "log_friction",
)  # fmt: skip
def fly(
    rows, start, h, left, bend, clock,
    center, rotation, linear, angular, time, acceleration, angular_acceleration, felt, detected_center, reach,
    inverse_mass, inertia, inverse_inertia, principal_axes,
    kind, ball, other, extent, radius, other_position, other_rotation, sign,
    friction, restitution, resting, impulse, friction_impulse,
    log_count, log_time, log_pair, log_point, log_normal, log_speed, log_impulse, log_friction,
):  # fmt: skip
    """Fly all bodies from ``start`` to ``h`` (s) into the substep and return (time reached, impacts logged, reason, cut).

    ``left`` is the time from the substep's end to the step's. Pairs are rows of the contact table with ``kind`` >= 0;
    their first body is the ball. Where a body comes to move faster than its detection foresaw, or the log is full,
    everything is brought to that instant and the reason returned; the caller detects anew, or grows the log, and calls
    again. ``cut`` counts impacts beyond the cap, which are let pass.
    """
    pairs = np.nonzero(kind >= 0)[0]
    most = IMPACTS_AT_LEAST + IMPACTS_PER_PAIR * len(pairs)
    capacity = len(log_time)

    # Which pairs each body takes part in, as slices of one array.
    begin = np.zeros(len(inverse_mass) + 1, np.int64)
    for p in pairs:
        begin[ball[p] + 1] += 1
        if other[p] >= 0:
            begin[other[p] + 1] += 1
    for i in range(1, len(begin)):
        begin[i] += begin[i - 1]
    place = begin.copy()
    of_body = np.empty(begin[-1], np.int64)
    for m in range(len(pairs)):
        for body in (ball[pairs[m]], other[pairs[m]]):
            if body >= 0:
                of_body[place[body]] = m
                place[body] += 1

    # A tournament of the foreseen times: node k is the sooner of 2k and 2k + 1, the leaves are the pairs.
    leaves = 1
    while leaves < len(pairs):
        leaves *= 2
    soonest = np.full(2 * leaves, NEVER)
    seek = np.empty(2 * len(pairs) + 2, np.int64)
    seek_count = len(pairs)
    for m in range(seek_count):
        seek[m] = m
    now, events, cut = start, 0, 0
    reason = DONE
    first = True
    while True:
        # Foresee the next impact of every pair whose bodies changed course.
        for index in range(seek_count):
            m = seek[index]
            p = pairs[m]
            i, o = ball[p], other[p]
            foreseen = NEVER
            ti = now - time[i]
            ci = bend * ti * ti
            x = center[i, 0] + linear[i, 0] * ti + acceleration[i, 0] * ci
            y = center[i, 1] + linear[i, 1] * ti + acceleration[i, 1] * ci
            z = center[i, 2] + linear[i, 2] * ti + acceleration[i, 2] * ci
            gi = 2.0 * bend * ti
            vx = linear[i, 0] + acceleration[i, 0] * gi
            vy = linear[i, 1] + acceleration[i, 1] * gi
            vz = linear[i, 2] + acceleration[i, 2] * gi
            ox, oy, oz = other_position[p, 0], other_position[p, 1], other_position[p, 2]
            qx, qy, qz, qw = other_rotation[p, 0], other_rotation[p, 1], other_rotation[p, 2], other_rotation[p, 3]
            ux, uy, uz, bx, by, bz, wx, wy, wz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
            if o >= 0:
                to = now - time[o]
                co = bend * to * to
                go = 2.0 * bend * to
                ox = center[o, 0] + linear[o, 0] * to + acceleration[o, 0] * co
                oy = center[o, 1] + linear[o, 1] * to + acceleration[o, 1] * co
                oz = center[o, 2] + linear[o, 2] * to + acceleration[o, 2] * co
                bx, by, bz = acceleration[o, 0], acceleration[o, 1], acceleration[o, 2]
                ux, uy, uz = linear[o, 0] + bx * go, linear[o, 1] + by * go, linear[o, 2] + bz * go
                if kind[p] != BALL:
                    wx, wy, wz = angular[o, 0], angular[o, 1], angular[o, 2]
                    qx, qy, qz, qw = spun(
                        rotation[o, 0], rotation[o, 1], rotation[o, 2], rotation[o, 3], wx, wy, wz, to
                    )
            if resting[p] and (not first or start > 0.0):
                # A resting pair is held by the solver; only a blow on one of its bodies makes it an impact.
                gap, nx, ny, nz = gap_of_ball(
                    kind[p], x, y, z, radius[p], ox, oy, oz, qx, qy, qz, qw, extent[p, 0], extent[p, 1], extent[p, 2]
                )
                closing = -(nx * (vx - ux) + ny * (vy - uy) + nz * (vz - uz))
                pressing = pressing_of(i, o, nx, ny, nz, felt)
                if gap <= TOUCH and closing > max(APPROACH, BLOW_SPEED_FACTOR * pressing * h):
                    resting[p] = False
            if not resting[p]:
                foreseen = now + first_touch(
                    kind[p], x, y, z, radius[p], vx, vy, vz, acceleration[i, 0], acceleration[i, 1], acceleration[i, 2],
                    ox, oy, oz, qx, qy, qz, qw, extent[p, 0], extent[p, 1], extent[p, 2],
                    ux, uy, uz, bx, by, bz, wx, wy, wz, bend, h - now,
                )  # fmt: skip
            enter_time(soonest, leaves + m, foreseen)
        first = False
        seek_count = 0

        if soonest[1] > h:
            now = h
            break
        m = 1
        while m < leaves:
            m *= 2
            if soonest[m] > soonest[m + 1]:
                m += 1
        now = max(now, soonest[m])
        m -= leaves
        p = pairs[m]
        if events >= most:
            cut += 1
            now = h
            break
        if log_count + 1 > capacity:
            reason = TABLE_FULL
            break
        i, o = ball[p], other[p]
        for body in (i, o):
            if body >= 0 and time[body] < now:
                advance_body(
                    body, now, bend, center, rotation, linear, angular, time, acceleration, angular_acceleration,
                    inertia, principal_axes,
                )  # fmt: skip
        ox, oy, oz = other_position[p, 0], other_position[p, 1], other_position[p, 2]
        qx, qy, qz, qw = other_rotation[p, 0], other_rotation[p, 1], other_rotation[p, 2], other_rotation[p, 3]
        if o >= 0:
            ox, oy, oz = center[o, 0], center[o, 1], center[o, 2]
            qx, qy, qz, qw = rotation[o, 0], rotation[o, 1], rotation[o, 2], rotation[o, 3]
        gap, nx, ny, nz = gap_of_ball(
            kind[p], center[i, 0], center[i, 1], center[i, 2], radius[p], ox, oy, oz, qx, qy, qz, qw,
            extent[p, 0], extent[p, 1], extent[p, 2],
        )  # fmt: skip

        # Velocity of the ball's surface relative to the other's, and the inverse mass they oppose to a push there.
        reach_i = radius[p] + 0.5 * gap
        rx, ry, rz = -nx * reach_i, -ny * reach_i, -nz * reach_i
        tx, ty, tz = cross(angular[i, 0], angular[i, 1], angular[i, 2], rx, ry, rz)
        sx, sy, sz = linear[i, 0] + tx, linear[i, 1] + ty, linear[i, 2] + tz
        px, py, pz = center[i, 0] + rx, center[i, 1] + ry, center[i, 2] + rz
        im = inverse_mass[i]
        ii = inverse_inertia[i, 0]
        kxx = im + ii * (ry * ry + rz * rz)
        kyy = im + ii * (rx * rx + rz * rz)
        kzz = im + ii * (rx * rx + ry * ry)
        kxy, kxz, kyz = -ii * rx * ry, -ii * rx * rz, -ii * ry * rz
        pressing = pressing_of(i, o, nx, ny, nz, felt)
        gx, gy, gz = 0.0, 0.0, 0.0
        if o >= 0:
            gx, gy, gz = px - center[o, 0], py - center[o, 1], pz - center[o, 2]
            tx, ty, tz = cross(angular[o, 0], angular[o, 1], angular[o, 2], gx, gy, gz)
            sx, sy, sz = sx - linear[o, 0] - tx, sy - linear[o, 1] - ty, sz - linear[o, 2] - tz
            ax_, ay_, az_, aw_ = product(
                qx, qy, qz, qw, principal_axes[o, 0], principal_axes[o, 1], principal_axes[o, 2], principal_axes[o, 3]
            )
            jx, jy, jz = inverse_inertia[o, 0], inverse_inertia[o, 1], inverse_inertia[o, 2]
            # Columns of [r]^T I^-1 [r] by pushing along each axis.
            cx, cy, cz = cross(gx, gy, gz, 1.0, 0.0, 0.0)
            cx, cy, cz = inverse_inertia_times(ax_, ay_, az_, aw_, jx, jy, jz, cx, cy, cz)
            cx, cy, cz = cross(cx, cy, cz, gx, gy, gz)
            kxx += inverse_mass[o] + cx
            kxy += cy
            kxz += cz
            cx, cy, cz = cross(gx, gy, gz, 0.0, 1.0, 0.0)
            cx, cy, cz = inverse_inertia_times(ax_, ay_, az_, aw_, jx, jy, jz, cx, cy, cz)
            cx, cy, cz = cross(cx, cy, cz, gx, gy, gz)
            kyy += inverse_mass[o] + cy
            kyz += cz
            cx, cy, cz = cross(gx, gy, gz, 0.0, 0.0, 1.0)
            cx, cy, cz = inverse_inertia_times(ax_, ay_, az_, aw_, jx, jy, jz, cx, cy, cz)
            cx, cy, cz = cross(cx, cy, cz, gx, gy, gz)
            kzz += inverse_mass[o] + cz
        vn = nx * sx + ny * sy + nz * sz
        if vn >= -APPROACH:
            # Pressed together without closing: no impulse, but the pair must not fall through.
            enter_time(soonest, leaves + m, NEVER)
            if stop_pressing(i, o, nx, ny, nz, inverse_mass, acceleration):
                for body in (i, o):
                    if body >= 0:
                        for slot in range(begin[body], begin[body + 1]):
                            if of_body[slot] != m:
                                seek[seek_count] = of_body[slot]
                                seek_count += 1
            continue
        # Forces press the bodies together, or what contacts with others do to their arcs.
        pressing = max(pressing, pressing_of(i, o, nx, ny, nz, acceleration))
        rest = REST_SPEED_FACTOR * max(0.0, pressing) * h
        bounce = restitution[p] if -vn > rest else 0.0
        jx, jy, jz, normal = struck(
            vn, sx, sy, sz, nx, ny, nz, (kxx, kxy, kxz, kyy, kyz, kzz), bounce, friction[p]
        )  # fmt: skip
        wx, wy, wz = cross(rx, ry, rz, jx, jy, jz)
        for k, (j, w) in enumerate(((jx, wx), (jy, wy), (jz, wz))):
            linear[i, k] += im * j
            angular[i, k] += ii * w
        if o >= 0:
            wx, wy, wz = cross(gx, gy, gz, jx, jy, jz)
            wx, wy, wz = inverse_inertia_times(
                ax_, ay_, az_, aw_, inverse_inertia[o, 0], inverse_inertia[o, 1], inverse_inertia[o, 2], wx, wy, wz
            )
            for k, (j, w) in enumerate(((jx, wx), (jy, wy), (jz, wz))):
                linear[o, k] -= inverse_mass[o] * j
                angular[o, k] -= w
        if bounce == 0.0:
            stop_pressing(i, o, nx, ny, nz, inverse_mass, acceleration)
        impulse[p] += normal
        s = sign[p]
        for k, (j, n, at) in enumerate(((jx, nx, px), (jy, ny, py), (jz, nz, pz))):
            friction_impulse[p, k] -= s * (j - normal * n)
            log_point[log_count, k] = at
            log_normal[log_count, k] = -s * n
            log_friction[log_count, k] = -s * (j - normal * n)
        log_time[log_count] = clock + now
        log_pair[log_count] = p
        log_speed[log_count] = -vn
        log_impulse[log_count] = normal
        log_count += 1
        events += 1

        # Both bodies are on new arcs: foresee all their pairs anew, and see whether detection still covers them.
        out = False
        for body in (i, o):
            if body < 0:
                continue
            for slot in range(begin[body], begin[body + 1]):
                if body == i or of_body[slot] != m:
                    seek[seek_count] = of_body[slot]
                    seek_count += 1
            away, speed, push = 0.0, 0.0, 0.0
            for k in range(3):
                away += (center[body, k] - detected_center[body, k]) ** 2
                speed += linear[body, k] ** 2
                push += felt[body, k] ** 2
            until = h - now + left
            out |= sqrt(away) + (sqrt(speed) + 0.5 * sqrt(push) * until) * until > reach[body]
        if out:
            reason = OUT_OF_REACH
            break
    for i in rows:
        if time[i] < now:
            advance_body(
                i, now, bend, center, rotation, linear, angular, time, acceleration, angular_acceleration,
                inertia, principal_axes,
            )  # fmt: skip
    return now, log_count, reason, cut


@inlined
def pressing_of(i, o, nx, ny, nz, acceleration):
    """Return how fast two bodies accelerate towards each other along the normal n from o to i."""
    pressing = -(nx * acceleration[i, 0] + ny * acceleration[i, 1] + nz * acceleration[i, 2])
    if o >= 0:
        pressing += nx * acceleration[o, 0] + ny * acceleration[o, 1] + nz * acceleration[o, 2]
    return pressing


@inlined
def stop_pressing(i, o, nx, ny, nz, inverse_mass, acceleration):
    """Take out of two arcs the acceleration by which the bodies press on each other, as a contact force would."""
    pressing = pressing_of(i, o, nx, ny, nz, acceleration)
    total = inverse_mass[i] + (inverse_mass[o] if o >= 0 else 0.0)
    if pressing <= 0.0:
        return False
    for k, n in enumerate((nx, ny, nz)):
        acceleration[i, k] += pressing * inverse_mass[i] / total * n
        if o >= 0:
            acceleration[o, k] -= pressing * inverse_mass[o] / total * n
    return True


@inlined
def enter_time(soonest, leaf, time):
    """Set a leaf of the tournament and play the games above it again."""
    soonest[leaf] = time
    while leaf > 1:
        leaf //= 2
        soonest[leaf] = min(soonest[2 * leaf], soonest[2 * leaf + 1])


@inlined
def advance_body(
    i, now, bend, center, rotation, linear, angular, time, acceleration, angular_acceleration, inertia, principal_axes
):
    """Bring one body along its arc to ``now``: half the turning kick, free rotation, the other half."""
    t = now - time[i]
    for k in range(3):
        center[i, k] += linear[i, k] * t + bend * acceleration[i, k] * t * t
        linear[i, k] += acceleration[i, k] * t
        angular[i, k] += bend * angular_acceleration[i, k] * t
    qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
    ax, ay, az, aw = principal_axes[i, 0], principal_axes[i, 1], principal_axes[i, 2], principal_axes[i, 3]
    qx, qy, qz, qw = product(qx, qy, qz, qw, ax, ay, az, aw)
    qx, qy, qz, qw, wx, wy, wz = freely_turned(
        qx, qy, qz, qw, angular[i, 0], angular[i, 1], angular[i, 2], inertia[i, 0], inertia[i, 1], inertia[i, 2], t
    )
    rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3] = product(qx, qy, qz, qw, -ax, -ay, -az, aw)
    angular[i, 0] = wx + (1.0 - bend) * angular_acceleration[i, 0] * t
    angular[i, 1] = wy + (1.0 - bend) * angular_acceleration[i, 1] * t
    angular[i, 2] = wz + (1.0 - bend) * angular_acceleration[i, 2] * t
    time[i] = now
