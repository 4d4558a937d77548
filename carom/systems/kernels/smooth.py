"""The end of a search between two round surfaces, where Newton's steps are as good as ten of any polytope's."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BRACKET, CURVED_STEP, CURVED_TURN
from carom.systems.kernels.cores import CORE, CYLINDER, ELLIPSOID, KIND, most_overlap
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import across

MOST_TURNS = 5


@inlined
def is_round(core):
    """Tell whether one of two cores has a round surface."""
    return CYLINDER <= core[KIND] <= ELLIPSOID or CYLINDER <= core[CORE + KIND] <= ELLIPSOID


@inlined
def beside(core, place, vertices, x, y, z, ux, uy, uz, vx, vy, vz):
    """Return (along u, along v): how far the difference's farthest point along a unit vector is beside its line."""
    wx, wy, wz, _, _, _ = most_overlap(core, place, vertices, x, y, z)
    along = wx * x + wy * y + wz * z
    wx, wy, wz = wx - along * x, wy - along * y, wz - along * z
    return wx * ux + wy * uy + wz * uz, wx * vx + wy * vy + wz * vz


@inlined
def turned_by(x, y, z, ux, uy, uz, s, vx, vy, vz, t):
    """Return a unit vector turned by small angles towards two others."""
    x, y, z = x + s * ux + t * vx, y + s * uy + t * vy, z + s * uz + t * vz
    scale = 1.0 / sqrt(x * x + y * y + z * z)
    return x * scale, y * scale, z * scale


@inlined
def settle(core, place, vertices, x, y, z):
    """Return (whether it was found, unit direction) where the overlap of two cores is least near a direction.

    There the farthest point of their difference is straight ahead. Its way beside the line has a slope where both
    surfaces are round, which is taken by differences; where faces, edges or straight lines meet it jumps, and nothing
    is found.
    """
    ux, uy, uz, vx, vy, vz = across(x, y, z)
    a, b = beside(core, place, vertices, x, y, z, ux, uy, uz, vx, vy, vz)
    mx, my, mz = turned_by(x, y, z, ux, uy, uz, CURVED_STEP, vx, vy, vz, 0.0)
    c, d = beside(core, place, vertices, mx, my, mz, ux, uy, uz, vx, vy, vz)
    mx, my, mz = turned_by(x, y, z, ux, uy, uz, 0.0, vx, vy, vz, CURVED_STEP)
    e, f = beside(core, place, vertices, mx, my, mz, ux, uy, uz, vx, vy, vz)
    c, d, e, f = (c - a) / CURVED_STEP, (d - b) / CURVED_STEP, (e - a) / CURVED_STEP, (f - b) / CURVED_STEP
    det = c * f - d * e
    if not (c > 0.0 and det > 0.0):
        return False, x, y, z
    s, t = 0.0, 0.0
    mx, my, mz = x, y, z
    for _ in range(MOST_TURNS):
        if a * a + b * b <= BRACKET * BRACKET:
            return True, mx, my, mz
        s, t = s - (f * a - e * b) / det, t - (c * b - d * a) / det
        if s * s + t * t > CURVED_TURN * CURVED_TURN:
            break
        mx, my, mz = turned_by(x, y, z, ux, uy, uz, s, vx, vy, vz, t)
        a, b = beside(core, place, vertices, mx, my, mz, ux, uy, uz, vx, vy, vz)
    return False, x, y, z
