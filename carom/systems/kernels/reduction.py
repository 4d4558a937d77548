"""Which points stand for a contact area."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.spatial import cross

MOST = 4


@woven
def reduce_area(place, gaps, names, count, nx, ny, nz):
    """Keep at most four points that span the area, moved to the front: deepest, farthest from it, widest either side.

    Of points as good to BIAS the first is taken, so that noise does not change the choice, which is made without
    branches, past foreseeing as it is. ``place`` holds three numbers a point.
    """
    if count <= MOST:
        return count
    deepest, least = 0, gaps[0]
    for k in range(1, count):
        deepest, least = (k, gaps[k]) if gaps[k] < least - BIAS else (deepest, least)
    ox, oy, oz = place[3 * deepest], place[3 * deepest + 1], place[3 * deepest + 2]
    farthest, most = deepest, 0.0
    for k in range(count):
        x, y, z = place[3 * k] - ox, place[3 * k + 1] - oy, place[3 * k + 2] - oz
        squared = x * x + y * y + z * z
        farthest, most = (k, squared) if squared > most * (1.0 + BIAS) else (farthest, most)
    ux, uy, uz = place[3 * farthest] - ox, place[3 * farthest + 1] - oy, place[3 * farthest + 2] - oz
    sx, sy, sz = cross(nx, ny, nz, ux, uy, uz)
    slack = BIAS * most
    left, right, leftmost, rightmost = -1, -1, 0.0, 0.0
    for k in range(count):
        side = sx * (place[3 * k] - ox) + sy * (place[3 * k + 1] - oy) + sz * (place[3 * k + 2] - oz)
        left, leftmost = (k, side) if side > leftmost + slack else (left, leftmost)
        right, rightmost = (k, side) if side < rightmost - slack else (right, rightmost)
    kept = 0
    for k in range(count):
        gaps[kept], names[kept] = gaps[k], names[k]
        for d in range(3):
            place[3 * kept + d] = place[3 * k + d]
        kept += 1 if k in (deepest, farthest, left, right) else 0
    return kept
