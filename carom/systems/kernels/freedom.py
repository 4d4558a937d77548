"""Freedom: what the locked axes of a body, in the world's frame, leave of its inertia and of its turning."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import HELD, HELD_TURN, HELD_TURNS
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import inverse_inertia_in_world, product, spun, turn


@inlined
def held_inverse(qx, qy, qz, qw, ix, iy, iz, fx, fy, fz):
    """Return the upper half of the inverse inertia in the world, q from principal axes to world, i inverse moments.

    Where f is 0 the body cannot turn about that axis: something gives it whatever torque that takes. What is left is
    the inverse of the inertia about the free axes, not the free part of the inverse, which would give energy to bodies
    whose principal axes are askew.
    """
    if ix == iy and iy == iz:
        return ix * fx, 0.0, 0.0, ix * fy, 0.0, ix * fz
    xx, xy, xz, yy, yz, zz = inverse_inertia_in_world(qx, qy, qz, qw, ix, iy, iz)
    least = HELD * (ix + iy + iz)
    if fx == 0.0:
        part = 1.0 / xx if xx > least else 0.0
        yy, yz, zz = yy - part * xy * xy, yz - part * xy * xz, zz - part * xz * xz
        xx, xy, xz = 0.0, 0.0, 0.0
    if fy == 0.0:
        part = 1.0 / yy if yy > least else 0.0
        xx, xz, zz = xx - part * xy * xy, xz - part * xy * yz, zz - part * yz * yz
        xy, yy, yz = 0.0, 0.0, 0.0
    if fz == 0.0:
        part = 1.0 / zz if zz > least else 0.0
        xx, xy, yy = xx - part * xz * xz, xy - part * xz * yz, yy - part * yz * yz
        xz, yz, zz = 0.0, 0.0, 0.0
    return xx, xy, xz, yy, yz, zz


@inlined
def inverse_inertia_of(i, inverse_inertia, principal, freedom, rotation):
    """Return the upper half of the inverse inertia of body i in the world, as its locks leave it."""
    qx, qy, qz, qw = product(
        rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3],
        principal[i, 0], principal[i, 1], principal[i, 2], principal[i, 3],
    )  # fmt: skip
    ix, iy, iz = inverse_inertia[i, 0], inverse_inertia[i, 1], inverse_inertia[i, 2]
    return held_inverse(qx, qy, qz, qw, ix, iy, iz, freedom[i, 3], freedom[i, 4], freedom[i, 5])


@inlined
def held_turned(qx, qy, qz, qw, ax, ay, az, aw, wx, wy, wz, ix, iy, iz, fx, fy, fz, t):
    """Return (q, w) of a body with locked axes of rotation after t seconds; q from body to world, a principal axes.

    i are the principal moments. About one free axis the moment does not change; with two, the angular momentum about
    both stays and the velocity follows the moments, by the implicit midpoint rule: forth and back are the same, so that
    the energy error stays bounded.
    """
    if wx == 0.0 and wy == 0.0 and wz == 0.0:
        return qx, qy, qz, qw, wx, wy, wz
    if fx + fy + fz < 2.0 or (ix == iy and iy == iz) or ix == 0.0 or iy == 0.0 or iz == 0.0:
        px, py, pz, pw = spun(qx, qy, qz, qw, wx, wy, wz, t)
        return px, py, pz, pw, wx, wy, wz
    jx, jy, jz = 1.0 / ix, 1.0 / iy, 1.0 / iz
    px, py, pz, pw = product(qx, qy, qz, qw, ax, ay, az, aw)
    mx, my, mz = turn(-px, -py, -pz, pw, wx, wy, wz)
    mx, my, mz = turn(px, py, pz, pw, ix * mx, iy * my, iz * mz)
    ux, uy, uz = wx, wy, wz
    for _ in range(HELD_TURNS):
        px, py, pz, pw = spun(qx, qy, qz, qw, ux, uy, uz, 0.5 * t)
        vx, vy, vz = velocity_of(px, py, pz, pw, ax, ay, az, aw, mx, my, mz, jx, jy, jz, fx, fy, fz)
        off = abs(vx - ux) + abs(vy - uy) + abs(vz - uz)
        ux, uy, uz = vx, vy, vz
        if off <= HELD_TURN * (abs(ux) + abs(uy) + abs(uz)):
            break
    px, py, pz, pw = spun(qx, qy, qz, qw, ux, uy, uz, t)
    vx, vy, vz = velocity_of(px, py, pz, pw, ax, ay, az, aw, mx, my, mz, jx, jy, jz, fx, fy, fz)
    return px, py, pz, pw, vx, vy, vz


@inlined
def velocity_of(qx, qy, qz, qw, ax, ay, az, aw, mx, my, mz, jx, jy, jz, fx, fy, fz):
    """Return the angular velocity of angular momentum m about the free axes."""
    qx, qy, qz, qw = product(qx, qy, qz, qw, ax, ay, az, aw)
    xx, xy, xz, yy, yz, zz = held_inverse(qx, qy, qz, qw, jx, jy, jz, fx, fy, fz)
    return xx * mx + xy * my + xz * mz, xy * mx + yy * my + yz * mz, xz * mx + yz * my + zz * mz
