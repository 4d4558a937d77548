"""Segments: their points nearest to a point, to each other and to a box."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import LEAST_PART, PARALLEL_EDGES
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import cross


@inlined
def across(x, y, z):
    """Return a unit vector at a right angle to a unit vector: horizontal where that gives a direction."""
    if abs(y) < 0.9:
        inverse = 1.0 / sqrt(x * x + z * z)
        return z * inverse, 0.0, -x * inverse
    inverse = 1.0 / sqrt(x * x + y * y)
    return -y * inverse, x * inverse, 0.0


@inlined
def direction_between(dx, dy, dz, ux, uy, uz, vx, vy, vz):
    """Return (length, unit vector) of d, which leads from a segment along u to one along v.

    Where they meet it is the common normal of the two, or of u alone if they are parallel.
    """
    length = sqrt(dx * dx + dy * dy + dz * dz)
    if length > LEAST_PART:
        return length, dx / length, dy / length, dz / length
    nx, ny, nz = cross(ux, uy, uz, vx, vy, vz)
    sine = nx * nx + ny * ny + nz * nz
    if sine <= PARALLEL_EDGES:
        nx, ny, nz = across(ux, uy, uz)
        return 0.0, nx, ny, nz
    sine = sqrt(sine)
    return 0.0, nx / sine, ny / sine, nz / sine


@inlined
def nearest_of_segments(dx, dy, dz, ux, uy, uz, half_u, vx, vy, vz, half_v):
    """Return (s, t) of the nearest points s u and d + t v of two segments about their middles, u and v being unit.

    Of parallel ones it is the middle of what lies side by side (Ericson, Real-Time Collision Detection, 5.1.9).
    """
    cosine = ux * vx + uy * vy + uz * vz
    along_u, along_v = dx * ux + dy * uy + dz * uz, dx * vx + dy * vy + dz * vz
    nx, ny, nz = cross(ux, uy, uz, vx, vy, vz)
    squared = nx * nx + ny * ny + nz * nz
    if squared > PARALLEL_EDGES:
        s = min(max((along_u - cosine * along_v) / squared, -half_u), half_u)
    else:
        low, high = beside(along_u, cosine, half_u, half_v)
        s = min(max(0.5 * (low + high), -half_u), half_u)
    t = cosine * s - along_v
    if abs(t) > half_v:
        t = half_v if t > 0.0 else -half_v
        s = min(max(cosine * t + along_u, -half_u), half_u)
    return s, t


@inlined
def beside(along_u, cosine, half_u, half_v):
    """Return (low, high) of the part of a segment that lies beside another one, whose middle is at ``along_u``."""
    width = half_v * abs(cosine)
    return max(-half_u, along_u - width), min(half_u, along_u + width)
