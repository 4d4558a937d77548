"""How far a shape moves straight on until it touches another: Newton's method on the gap of two convex cores.

As a convex solid moves straight on, its gap to another is a convex function of the way, and planes that part the two
bound it from below: a step to where the planes meet never goes too far, and the steps end as Newton's do (compare van
den Bergen, Ray Casting against General Convex Objects with Application to Continuous Collision Detection, 2004).
"""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import CAST_BACK, CAST_GAP
from carom.systems.kernels.cores import (
    AROUND,
    CORE,
    CYLINDER,
    ELLIPSOID,
    EXTENT,
    KIND,
    OFFSET,
    POINT,
    POSITION,
    SECOND,
    farthest,
    into,
    out_of,
)
from carom.systems.kernels.distance import APART, FAR, MEETING
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.nearing import near
from carom.systems.kernels.rounds import parted_from_point

MISSED, TOUCHED, BEGUN = 0, 1, 2  # BEGUN: the cores meet before the second has moved
MOST_APPROACHES = 64  # steps; 4 are usual


@inlined
def gap_of_point(core, x, y, z):
    """Return (gap, outward unit normal) of the second core, a round one, and a point in its frame."""
    gap, nx, ny, nz = parted_from_point(core, 0, x, y, z)
    for way in (1, 2):
        other, mx, my, mz = parted_from_point(core, way, x, y, z)
        if other > gap:
            gap, nx, ny, nz = other, mx, my, mz
    return gap, nx, ny, nz


@inlined
def approach(core, place, vertices, ux, uy, uz, limit, mirrored, corner, name, weight, seen):
    """Return (state, way, unit normal, point) of the second core, which moves along u, and the first, in whose frame.

    The normal is out of the first, the point on it. Where the cores have come so near that their distance has no
    direction, the last step is taken from CAST_BACK before, and the longer of both ways counts. Points have their gap
    to round cores in closed form, for which ``mirrored`` is room for two cores.
    """
    ox, oy, oz = place[POSITION], place[POSITION + 1], place[POSITION + 2]
    length = sqrt(ox * ox + oy * oy + oz * oz)
    nx, ny, nz = (ox / length, oy / length, oz / length) if length > 0.0 else (-ux, -uy, -uz)
    px, py, pz, way, reached, state, closing, last = 0.0, 0.0, 0.0, 0.0, 0.0, BEGUN, 1.0, False
    around = core[AROUND] + core[CORE + AROUND]
    of_point = core[CORE + KIND] == POINT and CYLINDER <= core[KIND] <= ELLIPSOID
    for d in range(CORE):
        mirrored[CORE + d] = core[d]
    for _ in range(MOST_APPROACHES):
        place[POSITION], place[POSITION + 1], place[POSITION + 2] = ox + way * ux, oy + way * uy, oz + way * uz
        if of_point:
            x, y, z = place[POSITION], place[POSITION + 1], place[POSITION + 2]
            gap, mx, my, mz = gap_of_point(mirrored, x, y, z)
            found, qx, qy, qz = APART, x - gap * mx, y - gap * my, z - gap * mz
        else:
            found, gap, mx, my, mz, qx, qy, qz = near(
                core, place, vertices, nx, ny, nz, limit - way + around, CAST_GAP, corner, name, weight, seen
            )
        if found == FAR:
            state = MISSED
            break
        if found == MEETING:
            if state == BEGUN or last:
                break
            reached, way, last = way, max(way - CAST_BACK / closing, 0.0), True
            continue
        nx, ny, nz = mx, my, mz
        px, py, pz = qx + core[AROUND] * nx, qy + core[AROUND] * ny, qz + core[AROUND] * nz
        gap -= around
        closing = -(nx * ux + ny * uy + nz * uz)
        if closing <= 0.0 or way + gap / closing > limit:
            state = MISSED
            break
        state = TOUCHED
        way = max(way, way + gap / closing, reached)
        if gap <= CAST_GAP or last:
            break
    place[POSITION], place[POSITION + 1], place[POSITION + 2] = ox, oy, oz
    return state, way, nx, ny, nz, px, py, pz


@inlined
def approach_half_space(core, place, vertices, ux, uy, uz, limit):
    """Return what `approach` does, onto the half space that the first core is."""
    nx, ny, nz = core[EXTENT], core[EXTENT + 1], core[EXTENT + 2]
    lx, ly, lz = into(place, -nx, -ny, -nz)
    lx, ly, lz = farthest(core, SECOND, vertices, lx, ly, lz)
    x, y, z = out_of(place, lx, ly, lz)
    x, y, z = x + place[POSITION], y + place[POSITION + 1], z + place[POSITION + 2]
    gap = nx * x + ny * y + nz * z - core[OFFSET] - core[CORE + AROUND]
    closing = -(nx * ux + ny * uy + nz * uz)
    if closing <= 0.0 or gap > limit * closing:
        return MISSED, 0.0, nx, ny, nz, x, y, z
    way, back = max(gap / closing, 0.0), core[CORE + AROUND]
    x, y, z = x + way * ux - back * nx, y + way * uy - back * ny, z + way * uz - back * nz
    return TOUCHED, way, nx, ny, nz, x, y, z
