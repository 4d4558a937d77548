"""One pair of bodies whose impacts are exact: when they strike next, and what a strike does to them."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APPROACH, TOUCH
from carom.systems.kernels.balls import BALL, NEVER, first_touch, gap_of_ball, pose_of_other
from carom.systems.kernels.bodies import (
    hardness,
    push_at,
    stop_pressing,
    surface_velocity,
    turned_by,
)
from carom.systems.kernels.bouncing import bounce_of
from carom.systems.kernels.coming_up import coming_up
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.point_impulse import struck, within_energy
from carom.systems.kernels.spatial import cross, spun


@inlined
def foresee(
    p, i, o, now, h, limit, bend, center, rotation, linear, angular, time, acceleration,
    kind, radius, extent, other_position, other_rotation, resting, joined,
):  # fmt: skip
    """Return when the bodies of pair p strike each other within the substep, NEVER if they do not.

    A resting pair is held by the solver; only a blow on one of its bodies makes it an impact, by which they close
    faster than ``limit`` (m/s), or across a gap: but who is ``joined`` to somebody rests before he lands.
    """
    t = now - time[i]
    c, g = bend * t * t, 2.0 * bend * t
    ax, ay, az = acceleration[i, 0], acceleration[i, 1], acceleration[i, 2]
    x = center[i, 0] + linear[i, 0] * t + ax * c
    y = center[i, 1] + linear[i, 1] * t + ay * c
    z = center[i, 2] + linear[i, 2] * t + az * c
    vx, vy, vz = linear[i, 0] + ax * g, linear[i, 1] + ay * g, linear[i, 2] + az * g
    ox, oy, oz = other_position[p, 0], other_position[p, 1], other_position[p, 2]
    qx, qy, qz, qw = other_rotation[p, 0], other_rotation[p, 1], other_rotation[p, 2], other_rotation[p, 3]
    ux, uy, uz, bx, by, bz, wx, wy, wz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    if o >= 0:
        t = now - time[o]
        c, g = bend * t * t, 2.0 * bend * t
        bx, by, bz = acceleration[o, 0], acceleration[o, 1], acceleration[o, 2]
        ox = center[o, 0] + linear[o, 0] * t + bx * c
        oy = center[o, 1] + linear[o, 1] * t + by * c
        oz = center[o, 2] + linear[o, 2] * t + bz * c
        ux, uy, uz = linear[o, 0] + bx * g, linear[o, 1] + by * g, linear[o, 2] + bz * g
        if kind[p] != BALL:
            wx, wy, wz = angular[o, 0], angular[o, 1], angular[o, 2]
            qx, qy, qz, qw = spun(rotation[o, 0], rotation[o, 1], rotation[o, 2], rotation[o, 3], wx, wy, wz, t)
    ex, ey, ez = extent[p, 0], extent[p, 1], extent[p, 2]
    if resting[p]:
        gap, nx, ny, nz = gap_of_ball(kind[p], x, y, z, radius[p], ox, oy, oz, qx, qy, qz, qw, ex, ey, ez)
        closing = -(nx * (vx - ux) + ny * (vy - uy) + nz * (vz - uz))
        if (gap > TOUCH and joined) or (gap <= TOUCH and closing <= limit):
            return NEVER
        resting[p] = False
    return now + first_touch(
        kind[p], x, y, z, radius[p], vx, vy, vz, ax, ay, az, ox, oy, oz, qx, qy, qz, qw, ex, ey, ez,
        ux, uy, uz, bx, by, bz, wx, wy, wz, bend, h - now,
    )  # fmt: skip


@inlined
def strike(
    p, i, o, h, struck_before, center, rotation, linear, angular, acceleration, felt,
    inverse_mass, inverse_inertia, principal_axes, freedom,
    kind, radius, extent, other_position, other_rotation, sign, surface, friction, restitution,
):  # fmt: skip
    """Let the bodies of pair p strike each other where they are, having done so ``struck_before`` times in the substep.

    Returns (closing speed, normal impulse, normal from the other to the ball, point, impulse on the ball, whether they
    stay together). A speed of 0 means that they are pressed together without closing: no impulse, but then, as after a
    plastic impact, what presses them is taken out of their arcs.
    """
    ox, oy, oz, qx, qy, qz, qw = pose_of_other(p, o, center, rotation, other_position, other_rotation)
    gap, nx, ny, nz = gap_of_ball(
        kind[p], center[i, 0], center[i, 1], center[i, 2], radius[p], ox, oy, oz, qx, qy, qz, qw,
        extent[p, 0], extent[p, 1], extent[p, 2],
    )  # fmt: skip
    lever = radius[p] + 0.5 * gap
    rx, ry, rz = -nx * lever, -ny * lever, -nz * lever
    px, py, pz = center[i, 0] + rx, center[i, 1] + ry, center[i, 2] + rz
    gx, gy, gz = px - ox, py - oy, pz - oz
    ax, ay, az = surface_velocity(i, rx, ry, rz, linear, angular)
    bx, by, bz = surface_velocity(o, gx, gy, gz, linear, angular)
    sx, sy, sz = ax - bx, ay - by, az - bz
    vn = nx * sx + ny * sy + nz * sz
    if vn >= -APPROACH:
        stop_pressing(i, o, nx, ny, nz, inverse_mass, freedom, acceleration)
        return 0.0, 0.0, nx, ny, nz, px, py, pz, 0.0, 0.0, 0.0, True
    across = nx * surface[p, 0] + ny * surface[p, 1] + nz * surface[p, 2]  # the normal is not that of detection
    sx -= sign[p] * (surface[p, 0] - across * nx)
    sy -= sign[p] * (surface[p, 1] - across * ny)
    sz -= sign[p] * (surface[p, 2] - across * nz)
    kxx, kxy, kxz, kyy, kyz, kzz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for body, x, y, z in ((i, rx, ry, rz), (o, gx, gy, gz)):
        if body >= 0:
            m = inverse_mass[body]
            # Columns of the 3 x 3 inverse mass at the point: (I^-1 (r x e)) x r for each axis e.
            tx, ty, tz = turned_by(body, 0.0, z, -y, inverse_inertia, principal_axes, freedom, rotation)
            cx, cy, cz = cross(tx, ty, tz, x, y, z)
            kxx, kxy, kxz = kxx + m * freedom[body, 0] + cx, kxy + cy, kxz + cz
            tx, ty, tz = turned_by(body, -z, 0.0, x, inverse_inertia, principal_axes, freedom, rotation)
            cx, cy, cz = cross(tx, ty, tz, x, y, z)
            kyy, kyz = kyy + m * freedom[body, 1] + cy, kyz + cz
            tx, ty, tz = turned_by(body, y, -x, 0.0, inverse_inertia, principal_axes, freedom, rotation)
            cx, cy, cz = cross(tx, ty, tz, x, y, z)
            kzz = kzz + m * freedom[body, 2] + cz
    knx, kny, knz = kxx * nx + kxy * ny + kxz * nz, kxy * nx + kyy * ny + kyz * nz, kxz * nx + kyz * ny + kzz * nz
    if hardness(nx * knx + ny * kny + nz * knz, i, o, inverse_mass) == 0.0:  # what is locked lets the other pass
        return 0.0, 0.0, nx, ny, nz, px, py, pz, 0.0, 0.0, 0.0, True
    turning = coming_up(o, i, gx, gy, gz, rx, ry, rz, nx, ny, nz, linear, angular, inverse_mass)
    bounce = bounce_of(restitution[p], -vn, i, o, nx, ny, nz, h, struck_before, felt, acceleration, turning)
    k = (kxx, kxy, kxz, kyy, kyz, kzz)
    jx, jy, jz, normal = struck(vn, sx, sy, sz, nx, ny, nz, k, bounce, friction[p])
    if friction[p] > 0.0:
        jx, jy, jz, normal = within_energy(jx, jy, jz, normal, vn, sx, sy, sz, nx, ny, nz, k)
    push_at(
        i, 1.0, jx, jy, jz, rx, ry, rz, linear, angular,
        inverse_mass, inverse_inertia, principal_axes, freedom, rotation,
    )  # fmt: skip
    push_at(
        o, -1.0, jx, jy, jz, gx, gy, gz, linear, angular,
        inverse_mass, inverse_inertia, principal_axes, freedom, rotation,
    )  # fmt: skip
    if bounce == 0.0:
        stop_pressing(i, o, nx, ny, nz, inverse_mass, freedom, acceleration)
    return -vn, normal, nx, ny, nz, px, py, pz, jx, jy, jz, bounce == 0.0
