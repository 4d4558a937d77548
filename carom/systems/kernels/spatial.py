"""Scalar vector and quaternion arithmetic for kernels."""

from __future__ import annotations

from math import sqrt

from carom.ecs.spatial import scalars, trigonometry
from carom.systems.constants import SMALL_ANGLE
from carom.systems.kernels.kernel import calling, inlined

series = inlined(trigonometry.series)
sine_cosine = inlined(calling(trigonometry.sine_cosine, series=series))
exponential = inlined(trigonometry.exponential)
cross = inlined(scalars.cross)
turn = inlined(scalars.turn)
product = inlined(scalars.product)


@inlined
def across(x, y, z):  # type: ignore[no-untyped-def]
    """Return two unit vectors at right angles to a unit vector and to each other."""
    if abs(x) <= abs(y) and abs(x) <= abs(z):
        ux, uy, uz = 0.0, -z, y
    elif abs(y) <= abs(z):
        ux, uy, uz = z, 0.0, -x
    else:
        ux, uy, uz = -y, x, 0.0
    scale = 1.0 / sqrt(ux * ux + uy * uy + uz * uz)
    ux, uy, uz = ux * scale, uy * scale, uz * scale
    vx, vy, vz = cross(x, y, z, ux, uy, uz)
    return ux, uy, uz, vx, vy, vz


@inlined
def spun(qx, qy, qz, qw, wx, wy, wz, t):  # type: ignore[no-untyped-def]
    """Return the quaternion after turning at angular velocity w (rad/s, outer frame) for t seconds."""
    squared = (wx * wx + wy * wy + wz * wz) * t * t
    if squared < SMALL_ANGLE * SMALL_ANGLE:
        scale, c = 0.5 * t, 1.0
    else:
        angle = sqrt(squared)
        s, c = sine_cosine(0.5 * angle)
        scale = s / angle * t
    x, y, z, w = product(wx * scale, wy * scale, wz * scale, c, qx, qy, qz, qw)
    inverse = 1.0 / sqrt(x * x + y * y + z * z + w * w)
    return x * inverse, y * inverse, z * inverse, w * inverse


@inlined
def inverse_inertia_times(qx, qy, qz, qw, ix, iy, iz, x, y, z):  # type: ignore[no-untyped-def]
    """Return I^-1 v in the world frame, q from principal axes to world, i the inverse principal moments."""
    if ix == iy and iy == iz:
        return ix * x, ix * y, ix * z
    lx, ly, lz = turn(-qx, -qy, -qz, qw, x, y, z)
    return turn(qx, qy, qz, qw, ix * lx, iy * ly, iz * lz)


@inlined
def freely_turned(qx, qy, qz, qw, wx, wy, wz, ix, iy, iz, t):  # type: ignore[no-untyped-def]
    """Return (q, w) of a free body after t seconds; q from principal axes to world, i the principal moments.

    The Hamiltonian is split by principal axis and each part flows exactly, in the symmetric order 1 2 3 2 1: angular
    momentum is kept to rounding, the energy error stays bounded (Dullweber, Leimkuhler and McLachlan, J. Chem. Phys.
    107, 5840, 1997, section III).
    """
    if (ix == iy and iy == iz) or ix == 0.0 or iy == 0.0 or iz == 0.0:
        nx, ny, nz, nw = spun(qx, qy, qz, qw, wx, wy, wz, t)
        return nx, ny, nz, nw, wx, wy, wz
    lx, ly, lz = turn(-qx, -qy, -qz, qw, wx, wy, wz)
    mx, my, mz = ix * lx, iy * ly, iz * lz
    gx, gy, gz = turn(qx, qy, qz, qw, mx, my, mz)  # angular momentum in the world, which stays
    for part in range(5):
        axis = part if part < 3 else 4 - part
        share = t if axis == 2 else 0.5 * t
        if axis == 0:
            s, c = sine_cosine(0.5 * share * mx / ix)
            qx, qy, qz, qw = product(qx, qy, qz, qw, s, 0.0, 0.0, c)
        elif axis == 1:
            s, c = sine_cosine(0.5 * share * my / iy)
            qx, qy, qz, qw = product(qx, qy, qz, qw, 0.0, s, 0.0, c)
        else:
            s, c = sine_cosine(0.5 * share * mz / iz)
            qx, qy, qz, qw = product(qx, qy, qz, qw, 0.0, 0.0, s, c)
        mx, my, mz = turn(-qx, -qy, -qz, qw, gx, gy, gz)
    inverse = 1.0 / sqrt(qx * qx + qy * qy + qz * qz + qw * qw)
    qx, qy, qz, qw = qx * inverse, qy * inverse, qz * inverse, qw * inverse
    mx, my, mz = turn(-qx, -qy, -qz, qw, gx, gy, gz)
    wx, wy, wz = turn(qx, qy, qz, qw, mx / ix, my / iy, mz / iz)
    return qx, qy, qz, qw, wx, wy, wz


@inlined
def plane_axes(nx, ny, nz):  # type: ignore[no-untyped-def]
    """Return two unit vectors that span the plane of the unit normal n, right-handed with it.

    Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6 (1), 2017.
    """
    sign = 1.0 if nz >= 0.0 else -1.0
    p = -1.0 / (sign + nz)
    q = nx * ny * p
    return 1.0 + sign * nx * nx * p, sign * q, -sign * nx, q, sign + ny * ny * p, -ny
