"""Manifolds: runs of contact points that a pair has on one plane, and what the resting stage needs to know of them."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import MANIFOLD_POINTS, SAME_NORMAL, SINGULAR
from carom.systems.kernels.bodies import hardness, inverse_mass_along, write_spread
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.spatial import cross, plane_axes

# Columns of what is known of a manifold: two tangents, the middle of its points from both bodies, the inverse of the
# inverse mass along the tangents (a symmetric 2 x 2), the inertia about the normal, and about any axis across it.
TANGENT, MIDDLE_A, MIDDLE_B, GIVE, SPIN, ROLL, MANIFOLD_WIDTH = 0, 6, 9, 12, 15, 16, 17

# Columns of what is known of a point: its lever about a and b (r x n), the mass along the normal, and how far it is
# from the middle.
LEVER_A, LEVER_B, MASS, AWAY, POINT_WIDTH = 0, 3, 6, 7, 8


@kernel("start")
def find_manifolds(count, row_a, row_b, normal, start):
    """Write where each manifold begins, and one past the last; return how many there are."""
    number = 0
    for c in range(count):
        if number:
            first = start[number - 1]
            if row_a[c] == row_a[first] and row_b[c] == row_b[first] and c - first < MANIFOLD_POINTS:
                x, y, z = normal[first, 0], normal[first, 1], normal[first, 2]
                if x * normal[c, 0] + y * normal[c, 1] + z * normal[c, 2] >= SAME_NORMAL:
                    continue
        start[number] = c
        number += 1
    start[number] = count
    return number


@inlined
def about(i, x, y, z, spread):
    """Return I^-1 v of body i in the world frame; ``spread`` (n, 9) is that of `write_spread`."""
    return (
        spread[i, 3] * x + spread[i, 4] * y + spread[i, 5] * z,
        spread[i, 4] * x + spread[i, 6] * y + spread[i, 7] * z,
        spread[i, 5] * x + spread[i, 7] * y + spread[i, 8] * z,
    )


@kernel("spread", "known", "known_point")
def prepare_manifolds(
    rows, count, start, body_a, body_b, normal, offset_a, offset_b, resting,
    inverse_mass, inverse_inertia, principal, freedom, rotation, spread, known, known_point,
):  # fmt: skip
    """Write what is known of bodies, manifolds and points for the substep; of manifolds that rest only."""
    for i in rows:
        write_spread(i, inverse_mass, inverse_inertia, principal, freedom, rotation, spread)
    for m in range(count):
        first, end = start[m], start[m + 1]
        if not resting[first]:
            continue
        nx, ny, nz = normal[first, 0], normal[first, 1], normal[first, 2]
        tx, ty, tz, ux, uy, uz = plane_axes(nx, ny, nz)
        known[m, TANGENT], known[m, TANGENT + 1], known[m, TANGENT + 2] = tx, ty, tz
        known[m, TANGENT + 3], known[m, TANGENT + 4], known[m, TANGENT + 5] = ux, uy, uz
        ktt, ktu, kuu, spin, roll = 0.0, 0.0, 0.0, 0.0, 0.0
        for c in range(first, end):
            known_point[c, MASS] = 0.0
        for body, offset, middle, lever in (
            (body_a[first], offset_a, MIDDLE_A, LEVER_A), (body_b[first], offset_b, MIDDLE_B, LEVER_B)
        ):  # fmt: skip
            rx, ry, rz = 0.0, 0.0, 0.0
            for c in range(first, end):
                rx, ry, rz = rx + offset[c, 0], ry + offset[c, 1], rz + offset[c, 2]
            along = inverse_mass_along(body, nx, ny, nz, inverse_mass, freedom) if body >= 0 else 0.0
            share = 1.0 / (end - first)
            rx, ry, rz = rx * share, ry * share, rz * share
            known[m, middle], known[m, middle + 1], known[m, middle + 2] = rx, ry, rz
            for c in range(first, end):
                dx, dy, dz = offset[c, 0] - rx, offset[c, 1] - ry, offset[c, 2] - rz
                x, y, z = cross(dx, dy, dz, nx, ny, nz)
                known_point[c, AWAY] = sqrt(x * x + y * y + z * z)
                x, y, z = cross(offset[c, 0], offset[c, 1], offset[c, 2], nx, ny, nz)
                known_point[c, lever], known_point[c, lever + 1], known_point[c, lever + 2] = x, y, z
                if body >= 0:
                    wx, wy, wz = about(body, x, y, z, spread)
                    known_point[c, MASS] += along + x * wx + y * wy + z * wz
            if body >= 0:
                tax, tay, taz = cross(rx, ry, rz, tx, ty, tz)
                uax, uay, uaz = cross(rx, ry, rz, ux, uy, uz)
                wx, wy, wz = about(body, tax, tay, taz, spread)
                ktt += inverse_mass_along(body, tx, ty, tz, inverse_mass, freedom) + tax * wx + tay * wy + taz * wz
                ktu += uax * wx + uay * wy + uaz * wz
                for k, tu in enumerate((tx * ux, ty * uy, tz * uz)):  # they are at right angles where all axes are free
                    ktu -= inverse_mass[body] * tu * (1.0 - freedom[body, k])
                wx, wy, wz = about(body, uax, uay, uaz, spread)
                kuu += inverse_mass_along(body, ux, uy, uz, inverse_mass, freedom) + uax * wx + uay * wy + uaz * wz
                wx, wy, wz = about(body, nx, ny, nz, spread)
                spin += nx * wx + ny * wy + nz * wz
                roll += max(inverse_inertia[body, 0], inverse_inertia[body, 1], inverse_inertia[body, 2])
        for c in range(first, end):
            known_point[c, MASS] = hardness(known_point[c, MASS], body_a[first], body_b[first], inverse_mass)
        determinant = ktt * kuu - ktu * ktu
        if determinant <= SINGULAR * (ktt + kuu) ** 2:  # one direction is locked, and as good as any in the other
            ktt, ktu, kuu = ktt + kuu, 0.0, ktt + kuu
            determinant = ktt * kuu
        inverse = inverse_or_none(determinant)
        known[m, GIVE], known[m, GIVE + 1], known[m, GIVE + 2] = kuu * inverse, -ktu * inverse, ktt * inverse
        known[m, SPIN], known[m, ROLL] = inverse_or_none(spin), inverse_or_none(roll)


@inlined
def inverse_or_none(x):
    """Return 1 / x, and 0 where nothing can move."""
    return 1.0 / x if x > 0.0 else 0.0
