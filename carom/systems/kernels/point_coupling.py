"""Coupling: how fast an impulse at one point of two bodies parts them there and at others."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels.freedom import inverse_inertia_of
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import cross


@inlined
def couple_points(i, contacts, offset, inverse_mass, inverse_inertia, principal, freedom, rotation, coupling):
    """Add what body i, which may be none, has to do with it to ``coupling`` (n, n, 9) of n contacts.

    ``coupling[m, o]`` is the 3 x 3 matrix, row by row, by which a unit impulse at point m moves the body at point o:
    m^-1 e + (I^-1 (r_m x e)) x r_o for each axis e. Points are the ``offset`` of contacts.
    """
    if i < 0:
        return
    xx, xy, xz, yy, yz, zz = inverse_inertia_of(i, inverse_inertia, principal, freedom, rotation)
    for m, c in enumerate(contacts):
        rx, ry, rz = offset[c, 0], offset[c, 1], offset[c, 2]
        for axis in range(3):
            ex, ey, ez = 1.0 if axis == 0 else 0.0, 1.0 if axis == 1 else 0.0, 1.0 if axis == 2 else 0.0
            tx, ty, tz = cross(rx, ry, rz, ex, ey, ez)
            wx, wy, wz = xx * tx + xy * ty + xz * tz, xy * tx + yy * ty + yz * tz, xz * tx + yz * ty + zz * tz
            for o, other in enumerate(contacts):
                vx, vy, vz = cross(wx, wy, wz, offset[other, 0], offset[other, 1], offset[other, 2])
                coupling[m, o, axis] += vx + inverse_mass[i] * freedom[i, 0] * ex
                coupling[m, o, 3 + axis] += vy + inverse_mass[i] * freedom[i, 1] * ey
                coupling[m, o, 6 + axis] += vz + inverse_mass[i] * freedom[i, 2] * ez


@inlined
def yields_at(m, x, y, z, coupling):
    """Return by how much point m parts along a vector for an impulse of that: of a unit vector, for a unit impulse."""
    vx, vy, vz = parted(m, m, x, y, z, coupling)
    return x * vx + y * vy + z * vz


@inlined
def parted(m, o, jx, jy, jz, coupling):
    """Return how fast an impulse at point m parts the bodies at point o."""
    return (
        coupling[m, o, 0] * jx + coupling[m, o, 1] * jy + coupling[m, o, 2] * jz,
        coupling[m, o, 3] * jx + coupling[m, o, 4] * jy + coupling[m, o, 5] * jz,
        coupling[m, o, 6] * jx + coupling[m, o, 7] * jy + coupling[m, o, 8] * jz,
    )


@inlined
def part_points(m, jx, jy, jz, coupling, slips):
    """Change the velocities at which bodies part at all points, ``slips`` (n, 3), by an impulse at point m."""
    for o in range(len(slips)):
        x, y, z = parted(m, o, jx, jy, jz, coupling)
        slips[o, 0] += x
        slips[o, 1] += y
        slips[o, 2] += z
