"""Cylinders, cones and ellipsoids in their own frame: where one parts from an edge or a corner of something else."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BESIDE_FACE, LEAST_PART, ROUND_STEPS, SQUARE_ENOUGH
from carom.systems.kernels.cores import CONE, CORE, CYLINDER, EXTENT, KIND, SECOND, farthest
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import cross

SECTORS = 12  # of an arc; a solid whose sides change faster is a needle
HALVINGS = 44  # of two of them: what is left is rounding


@inlined
def parted_from_edge(core, vertices, ax, ay, az, bx, by, bz, qx, qy, qz, ux, uy, uz):
    """Return (unit direction, gap, farthest point against it) that parts the second core most from a line.

    Directions are those between a and b, square to the line through q along the unit vector u, about which a turns
    towards u x a. The best of SECTORS is the start: deep in a solid there are several. The gap grows further where the
    farthest point is beyond the line, which tells the half to look in; jumps, where faces and straight lines touch the
    edge, are found as well.
    """
    best, most = 0, -1e300
    for k in range(SECTORS + 1):
        mx, my, mz = between(ax, ay, az, bx, by, bz, k / SECTORS)
        px, py, pz = farthest(core, SECOND, vertices, -mx, -my, -mz)
        apart = mx * (px - qx) + my * (py - qy) + mz * (pz - qz)
        if apart > most:
            best, most = k, apart
    if best in (0, SECTORS):  # most often it is one of the faces beside the edge
        mx, my, mz = between(ax, ay, az, bx, by, bz, BESIDE_FACE if best == 0 else 1.0 - BESIDE_FACE)
        px, py, pz = farthest(core, SECOND, vertices, -mx, -my, -mz)
        tx, ty, tz = cross(ux, uy, uz, mx, my, mz)
        if (tx * (px - qx) + ty * (py - qy) + tz * (pz - qz) > 0.0) == (best == SECTORS):
            mx, my, mz = (ax, ay, az) if best == 0 else (bx, by, bz)
            return mx, my, mz, most, px, py, pz
    lx, ly, lz = between(ax, ay, az, bx, by, bz, max(best - 1, 0) / SECTORS)
    hx, hy, hz = between(ax, ay, az, bx, by, bz, min(best + 1, SECTORS) / SECTORS)
    under, over = 0.0, 0.0
    rx, ry, rz, sx, sy, sz = qx, qy, qz, qx, qy, qz
    mx, my, mz = ax, ay, az
    for _ in range(HALVINGS):
        mx, my, mz = between(lx, ly, lz, hx, hy, hz, 0.5)
        px, py, pz = farthest(core, SECOND, vertices, -mx, -my, -mz)
        tx, ty, tz = cross(ux, uy, uz, mx, my, mz)
        beyond = tx * (px - qx) + ty * (py - qy) + tz * (pz - qz)
        if beyond > 0.0:
            lx, ly, lz, rx, ry, rz, under = mx, my, mz, px, py, pz, beyond
        else:
            hx, hy, hz, sx, sy, sz, over = mx, my, mz, px, py, pz, -beyond
    share = under / (under + over) if under > 0.0 and over > 0.0 else 0.0 if under > 0.0 else 1.0
    px, py, pz = rx + share * (sx - rx), ry + share * (sy - ry), rz + share * (sz - rz)
    return mx, my, mz, mx * (px - qx) + my * (py - qy) + mz * (pz - qz), px, py, pz


@inlined
def between(ax, ay, az, bx, by, bz, share):
    """Return a unit vector between two."""
    x, y, z = ax + share * (bx - ax), ay + share * (by - ay), az + share * (bz - az)
    scale = 1.0 / sqrt(x * x + y * y + z * z)
    return x * scale, y * scale, z * scale


@inlined
def parted_from_point(core, way, x, y, z):
    """Return (gap, outward unit normal of the second core) along one of the ways that part it from a point.

    Way 0 is through its side and 1 through its end, from behind them and less far outside of the other than it is deep,
    and 2 is to where it is nearest from outside; of an ellipsoid 0 is all. What is no way has a gap of minus infinity.
    """
    a, b, kind = core[CORE + EXTENT], core[CORE + EXTENT + 1], core[CORE + KIND]
    if kind not in (CYLINDER, CONE):
        if way > 0:
            return -1e300, 0.0, 1.0, 0.0
        return parted_from_ellipsoid(a, b, core[CORE + EXTENT + 2], x, y, z)
    out, top = sqrt(x * x + z * z), a if kind == CYLINDER else 0.0
    ux, uz = (x / out, z / out) if out > 0.0 else (1.0, 0.0)
    slant = sqrt((a - top) * (a - top) + 4.0 * b * b)
    wide, high = 2.0 * b / slant, (a - top) / slant  # of the side's normal
    sign = -1.0 if y < 0.0 or kind == CONE else 1.0
    side, end = wide * (out - a) + high * (y + b), sign * y - b
    if way == 0 and side <= 0.0 and side < -end:
        return side, ux * wide, high, uz * wide
    if way == 1 and end <= 0.0 and end < -side:
        return end, 0.0, sign, 0.0
    if way < 2 or max(side, end) <= 0.0:
        return -1e300, 0.0, 1.0, 0.0
    if end > 0.0 and out <= (a if sign < 0.0 else top):
        return end, 0.0, sign, 0.0
    along = min(max((wide * (y + b) - high * (out - a)) / slant, 0.0), 1.0)  # up the side
    dx, dy = out - a - along * (top - a), y + b - 2.0 * b * along
    gap = sqrt(dx * dx + dy * dy)
    if gap <= LEAST_PART:
        return side, ux * wide, high, uz * wide
    return gap, ux * dx / gap, dy / gap, uz * dx / gap


@inlined
def parted_from_ellipsoid(a, b, c, x, y, z):
    """Return what `parted_from_point` does of an ellipsoid.

    The nearest point is R^2 x / (R^2 + t) with the root t of |R x / (R^2 + t)| = 1, to which Newton's steps lead from
    below without overshooting (Eberly, Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid, 2013).
    """
    least = LEAST_PART * min(a, b, c)
    t = max(a * max(abs(x), least) - a * a, b * max(abs(y), least) - b * b, c * max(abs(z), least) - c * c)
    aa, bb, cc = a * a + t, b * b + t, c * c + t
    for _ in range(ROUND_STEPS):
        aa, bb, cc = a * a + t, b * b + t, c * c + t
        u, v, w = a * x / aa, b * y / bb, c * z / cc
        over = u * u + v * v + w * w - 1.0
        slope = 2.0 * (u * u / aa + v * v / bb + w * w / cc)
        if over <= SQUARE_ENOUGH or not slope > 0.0:
            break
        t += over / slope
    px, py, pz = a * a * x / aa, b * b * y / bb, c * c * z / cc
    nx, ny, nz = px / (a * a), py / (b * b), pz / (c * c)
    length = sqrt(nx * nx + ny * ny + nz * nz)
    if not length > 0.0:
        return -min(a, b, c), 0.0, 1.0, 0.0
    nx, ny, nz = nx / length, ny / length, nz / length
    return nx * (x - px) + ny * (y - py) + nz * (z - pz), nx, ny, nz
