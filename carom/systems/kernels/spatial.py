"""Scalar vector and quaternion arithmetic for kernels."""

from __future__ import annotations

from math import sqrt
from typing import Any

# mypy: disable-error-code="no-untyped-call"
from carom.ecs.spatial import scalars, trigonometry
from carom.ecs.spatial.trigonometry import EIGHTH_SQUARED
from carom.systems.kernels.kernel import calling, inlined, woven

even_series = inlined(trigonometry.even_series)
series = inlined(calling(trigonometry.series, even_series=even_series))
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
    x, y, z, w = spinning(qx, qy, qz, qw, wx, wy, wz, t)
    inverse = 1.0 / sqrt(x * x + y * y + z * z + w * w)
    return x * inverse, y * inverse, z * inverse, w * inverse


@inlined
def spinning(qx, qy, qz, qw, wx, wy, wz, t):  # type: ignore[no-untyped-def]
    """Return what `spun` does, but for rounding of the length."""
    squared = 0.25 * ((wx * wx + wy * wy + wz * wz) * t * t)  # of half the angle
    if squared <= EIGHTH_SQUARED:
        s, c = even_series(squared)
        scale = 0.5 * t * (1.0 + squared * s)
    else:
        half = sqrt(squared)
        s, c = sine_cosine(half)
        scale = 0.5 * t * (s / half)
    return product(wx * scale, wy * scale, wz * scale, c, qx, qy, qz, qw)


@inlined
def inverse_inertia_times(qx, qy, qz, qw, ix, iy, iz, x, y, z):  # type: ignore[no-untyped-def]
    """Return I^-1 v in the world frame, q from principal axes to world, i the inverse principal moments."""
    if ix == iy and iy == iz:
        return ix * x, ix * y, ix * z
    lx, ly, lz = turn(-qx, -qy, -qz, qw, x, y, z)
    return turn(qx, qy, qz, qw, ix * lx, iy * ly, iz * lz)


@inlined
def inverse_inertia_in_world(qx, qy, qz, qw, ix, iy, iz):  # type: ignore[no-untyped-def]
    """Return the upper half of R diag(i) R^T, R the matrix of q from principal axes to world, i the inverse moments.

    Of one body, or of one in each lane.
    """
    tx, ty, tz = 2.0 * qx, 2.0 * qy, 2.0 * qz
    ax, ay, az = 1.0 - (qy * ty + qz * tz), qx * ty + qw * tz, qx * tz - qw * ty
    bx, by, bz = qx * ty - qw * tz, 1.0 - (qx * tx + qz * tz), qy * tz + qw * tx
    cx, cy, cz = qx * tz + qw * ty, qy * tz - qw * tx, 1.0 - (qx * tx + qy * ty)
    ux, uy, uz, vx, vy, vz = ix * ax, ix * ay, ix * az, iy * bx, iy * by, iy * bz
    wx, wy, wz = iz * cx, iz * cy, iz * cz
    return (
        ux * ax + vx * bx + wx * cx, ux * ay + vx * by + wx * cy, ux * az + vx * bz + wx * cz,
        uy * ay + vy * by + wy * cy, uy * az + vy * bz + wy * cz, uz * az + vz * bz + wz * cz,
    )  # fmt: skip


def turned_about(qx, qy, qz, qw, my, mz, half):  # type: ignore[no-untyped-def]
    """Return q, and angular momentum as the body sees it, after a turn about its first axis by twice ``half``."""
    s, c = sine_cosine(half)
    sine, cosine = 2.0 * s * c, 1.0 - 2.0 * s * s
    return (
        qw * s + qx * c, qy * c + qz * s, qz * c - qy * s, qw * c - qx * s,
        my * cosine + mz * sine, mz * cosine - my * sine,
    )  # fmt: skip


def turned_about_two(qx, qy, qz, qw, mx, my, mz, jx, jy):  # type: ignore[no-untyped-def]
    """Return q after turns about the first, the second and the first axis of a body, as `freely_turned` asks."""
    qx, qy, qz, qw, my, mz = turned_about(qx, qy, qz, qw, my, mz, jx * mx)
    qy, qz, qx, qw, mz, mx = turned_about(qy, qz, qx, qw, mz, mx, 2.0 * jy * my)
    qx, qy, qz, qw, my, mz = turned_about(qx, qy, qz, qw, my, mz, jx * mx)
    return qx, qy, qz, qw


def turned_by(sine_cosine: Any) -> Any:
    """Return `turned_about_two` compiled for numbers or for lanes, whose sine and cosine these are."""
    about = woven(calling(turned_about, sine_cosine=sine_cosine))
    return woven(calling(turned_about_two, turned_about=about))


turned_twice = turned_by(sine_cosine)


@inlined
def freely_turned(qx, qy, qz, qw, wx, wy, wz, ix, iy, iz, t):  # type: ignore[no-untyped-def]
    """Return (q, w) of a free body after t seconds; q from principal axes to world, i the principal moments.

    The part of the Hamiltonian that there would be if all moments were the middle one turns q evenly about the angular
    momentum; what is left, about the other two axes, flows exactly axis by axis, in the symmetric order 1 2 1. Angular
    momentum is kept to rounding and the energy error stays bounded (Dullweber, Leimkuhler and McLachlan, J. Chem. Phys.
    107, 5840, 1997, section III, where all of it is shared among the axes); two equal moments make it exact.
    """
    if (ix == iy and iy == iz) or ix == 0.0 or iy == 0.0 or iz == 0.0:
        nx, ny, nz, nw = spun(qx, qy, qz, qw, wx, wy, wz, t)
        return nx, ny, nz, nw, wx, wy, wz
    jx, jy, jz = 1.0 / ix, 1.0 / iy, 1.0 / iz
    lx, ly, lz = turn(-qx, -qy, -qz, qw, wx, wy, wz)
    mx, my, mz = ix * lx, iy * ly, iz * lz
    gx, gy, gz = turn(qx, qy, qz, qw, mx, my, mz)  # angular momentum in the world, which stays
    if (ix - iy) * (iz - iy) <= 0.0:  # the middle one of three axes in a circle comes last
        qx, qy, qz, qw = spinning(qx, qy, qz, qw, gx * jy, gy * jy, gz * jy, t)
        qz, qx, qy, qw = turned_twice(qz, qx, qy, qw, mz, mx, my, quarter(t, jz, jy), quarter(t, jx, jy))
    elif (iy - ix) * (iz - ix) <= 0.0:
        qx, qy, qz, qw = spinning(qx, qy, qz, qw, gx * jx, gy * jx, gz * jx, t)
        qy, qz, qx, qw = turned_twice(qy, qz, qx, qw, my, mz, mx, quarter(t, jy, jx), quarter(t, jz, jx))
    else:
        qx, qy, qz, qw = spinning(qx, qy, qz, qw, gx * jz, gy * jz, gz * jz, t)
        qx, qy, qz, qw = turned_twice(qx, qy, qz, qw, mx, my, mz, quarter(t, jx, jz), quarter(t, jy, jz))
    inverse = 1.0 / sqrt(qx * qx + qy * qy + qz * qz + qw * qw)
    qx, qy, qz, qw = qx * inverse, qy * inverse, qz * inverse, qw * inverse
    mx, my, mz = turn(-qx, -qy, -qz, qw, gx, gy, gz)
    wx, wy, wz = turn(qx, qy, qz, qw, mx * jx, my * jy, mz * jz)
    return qx, qy, qz, qw, wx, wy, wz


@woven
def quarter(t, j, middle):  # type: ignore[no-untyped-def]
    """Return half the angle per momentum by which an inverse moment turns in t/2 faster than the middle one."""
    return 0.25 * t * (j - middle)


@inlined
def plane_axes(nx, ny, nz):  # type: ignore[no-untyped-def]
    """Return two unit vectors that span the plane of the unit normal n, right-handed with it.

    Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6 (1), 2017.
    """
    sign = 1.0 if nz >= 0.0 else -1.0
    p = -1.0 / (sign + nz)
    q = nx * ny * p
    return 1.0 + sign * nx * nx * p, sign * q, -sign * nx, q, sign + ny * ny * p, -ny
