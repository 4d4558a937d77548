"""The impulse of two bodies that strike each other with one point: restitution, friction and the energy they have."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APPROACH, IMMOVABLE, SINGULAR
from carom.systems.kernels.kernel import inlined


@inlined
def times(k, x, y, z):
    """Return a symmetric 3 x 3 matrix, given by its upper half, times a vector."""
    xx, xy, xz, yy, yz, zz = k
    return xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z


@inlined
def struck(vn, sx, sy, sz, nx, ny, nz, k, restitution, friction):
    """Return the impulse (3) on the second body for closing velocity s with normal part vn < 0 at inverse mass k (3x3).

    Newton's restitution along the normal; the tangential part stops sliding if Coulomb's cone allows it, and else
    slides at the cone's edge (Mirtich, Impulse-based Dynamic Simulation, 1996, section 3.2, for two-stage impact laws).
    """
    kxx, kxy, kxz, kyy, kyz, kzz = k
    knx, kny, knz = times(k, nx, ny, nz)
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
    if determinant <= SINGULAR * (kxx + kyy + kzz) ** 3:
        tx, ty, tz = tx / sliding, ty / sliding, tz / sliding
        edge, normal = rubbed(sliding, tx, ty, tz, wanted, nx, ny, nz, knx, kny, knz, k, friction)
        return normal * nx - edge * tx, normal * ny - edge * ty, normal * nz - edge * tz, normal
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


@inlined
def rubbed(sliding, tx, ty, tz, wanted, nx, ny, nz, knx, kny, knz, k, friction):
    """Return how much a point rubs and is pressed, if it cannot move in all directions: against its sliding t only.

    What slides along an axis that both bodies have locked goes on sliding, so that it cannot stick. As much friction as
    the cone allows and as leaves it still the way that it can move takes energy, and turns nothing round. ``k`` yields
    in one direction of the plane at most: where something yields along the normal as well, that counts.
    """
    knn, knt = nx * knx + ny * kny + nz * knz, tx * knx + ty * kny + tz * knz
    gx, gy, gz = times(k, tx, ty, tz)
    gx, gy, gz = gx - knt / knn * knx, gy - knt / knn * kny, gz - knt / knn * knz
    squared, wished = gx * gx + gy * gy + gz * gz, 0.0
    if squared > (IMMOVABLE * (k[0] + k[3] + k[5])) ** 2:
        left = sliding * (gx * tx + gy * ty + gz * tz) + wanted / knn * (gx * knx + gy * kny + gz * knz)
        wished = max(0.0, left / squared)
    normal = (wanted + wished * knt) / knn
    if normal > 0.0 and wished <= friction * normal:
        return wished, normal
    normal = wanted / (knn - friction * knt)
    if normal <= 0.0:  # jamming: friction alone would stop the approach
        return 0.0, wanted / knn
    return friction * normal, normal


@inlined
def within_energy(jx, jy, jz, normal, vn, sx, sy, sz, nx, ny, nz, k):
    """Return an impulse cut so that it gives no energy, towards that which only stops the approach, which takes some.

    Newton's restitution asks for a speed of parting whatever friction does; where friction turns bodies that are askew,
    or on rails, into the normal, that speed may be more than they have energy for.
    """
    knx, kny, knz = times(k, nx, ny, nz)
    knn = nx * knx + ny * kny + nz * knz
    stopping = -vn / knn
    dx, dy, dz = jx - stopping * nx, jy - stopping * ny, jz - stopping * nz
    kdx, kdy, kdz = times(k, dx, dy, dz)
    squared = 0.5 * (dx * kdx + dy * kdy + dz * kdz)
    linear = dx * (sx + stopping * knx) + dy * (sy + stopping * kny) + dz * (sz + stopping * knz)
    taken = 0.5 * stopping * vn  # the energy in all is taken + linear part + squared part^2, below 0 at first
    if taken + linear + squared <= 0.0:
        return jx, jy, jz, normal
    root = sqrt(linear * linear - 4.0 * squared * taken)
    part = -2.0 * taken / (linear + root) if linear > 0.0 else (root - linear) / (2.0 * squared)
    return (
        stopping * nx + part * dx,
        stopping * ny + part * dy,
        stopping * nz + part * dz,
        stopping + part * (normal - stopping),
    )
