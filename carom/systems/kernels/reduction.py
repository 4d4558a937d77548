"""Which points stand for a contact area."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BETTER, BIAS
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.spatial import cross

SPANNING, MOST_POINTS = 4, 8
LATER = 1 << 40  # more than any name


@kernel("place", "gaps", "names")
def choose_of_area(place, gaps, names, nx, ny, nz):
    """Do what `reduce_area` does with points found one by one."""
    return reduce_area(place, gaps, names, len(gaps), nx, ny, nz)


@woven
def reduce_area(place, gaps, names, count, nx, ny, nz):
    """Keep at most eight points that stand for the area, the deepest and those of `span_area`; return their number."""
    if count <= SPANNING:
        return count
    put_deepest_first(place, gaps, names, count)
    kept = span_area(place, gaps, names, count, nx, ny, nz, BIAS)
    if kept > SPANNING:
        alternate(names, kept)
    return kept


@woven
def put_deepest_first(place, gaps, names, count):
    """Swap the deepest point and the first."""
    deepest, least = 0, gaps[0]
    for k in range(1, count):  # chosen, not branched on: which it is is past foreseeing
        deepest, least = (k, gaps[k]) if gaps[k] < least - BIAS else (deepest, least)
    swap(0, deepest, place, gaps, names)


@woven
def alternate(names, kept):
    """Let every other point around an area come after the rest, as contacts are sorted by their names.

    A manifold takes four of them, the next what is left: were these side by side, each would bear one half of the area,
    one after the other, and towers would sway for ever.
    """
    first = 0
    for k in range(1, kept):
        first = k if names[k] < names[first] else first
    for k in range(kept):
        names[k] += LATER * ((k - first) % kept % 2)


@woven
def span_area(place, gaps, names, count, nx, ny, nz, least):
    """Move the points that stand for the area to the front, after the first, around it as seen against the normal.

    They are the first, the farthest from it, and again and again the point that adds most area to the polygon of all
    chosen before: of those that touch up to eight, of others until there are four. A body would lean on a corner that
    is left out, which sinks until it is chosen for its depth, and then on that left out for it, and never come to rest.

    Of what lies on a line both ends stay. Points touch that are no farther than ``least`` (m), and add nothing where
    they stick out by less. Of points as good to BETTER the first is taken, so that noise does not change the choice.
    ``place`` holds three numbers a point.

    Return how many are chosen.
    """
    kept = span_roughly(place, gaps, names, count, nx, ny, nz, least)
    return extend_area(place, gaps, names, kept, MOST_POINTS, count, nx, ny, nz, least, least)


@woven
def span_roughly(place, gaps, names, count, nx, ny, nz, least):
    """Do what `span_area` does, until there are four."""
    farthest, most = -1, least * least
    for k in range(1, count):
        x, y, z = place[3 * k] - place[0], place[3 * k + 1] - place[1], place[3 * k + 2] - place[2]
        squared = x * x + y * y + z * z
        farthest, most = (k, squared * (1.0 + BETTER)) if squared > most else (farthest, most)
    if farthest < 0:
        return 1
    swap(1, farthest, place, gaps, names)
    kept = extend_area(place, gaps, names, 2, SPANNING, count, nx, ny, nz, least, least)
    return with_other_end(place, gaps, names, count, least) if kept == 2 else kept


@woven
def extend_area(place, gaps, names, kept, room, count, nx, ny, nz, least, near):
    """Move points that add area in among the ``kept`` ones, until there are as many as there is ``room`` for.

    Those beyond four are no farther than ``near`` (m).
    """
    while kept < min(room, count):
        widest, before, most = -1, 0, 0.0
        for e in range(kept):
            o = e + 1 if e + 1 < kept else 0
            ox, oy, oz = place[3 * e], place[3 * e + 1], place[3 * e + 2]
            ux, uy, uz = place[3 * o] - ox, place[3 * o + 1] - oy, place[3 * o + 2] - oz
            slack = least * sqrt(ux * ux + uy * uy + uz * uz)
            sx, sy, sz = cross(ux, uy, uz, nx, ny, nz)
            for k in range(kept, count):
                area = sx * (place[3 * k] - ox) + sy * (place[3 * k + 1] - oy) + sz * (place[3 * k + 2] - oz)
                if area > max(most, slack) and (kept < SPANNING or gaps[k] <= near):
                    widest, before, most = k, e, area * (1.0 + BETTER)
        if widest < 0:
            break
        for k in range(kept, before, -1):
            swap(k, widest if k == kept else k + 1, place, gaps, names)
        kept += 1
    return kept


@woven
def with_other_end(place, gaps, names, count, least):
    """Move the other end of what lies on a line behind its first two points, the first of which may be within it."""
    x, y, z = place[3] - place[0], place[4] - place[1], place[5] - place[2]
    length = sqrt(x * x + y * y + z * z)
    other, most = -1, least * length
    for k in range(2, count):
        back = -(x * (place[3 * k] - place[0]) + y * (place[3 * k + 1] - place[1]) + z * (place[3 * k + 2] - place[2]))
        other, most = (k, back * (1.0 + BETTER)) if back > most else (other, most)
    if other < 0:
        return 2
    swap(2, other, place, gaps, names)
    return 3


@woven
def swap(k, o, place, gaps, names):
    """Swap two points."""
    gaps[k], gaps[o] = gaps[o], gaps[k]
    names[k], names[o] = names[o], names[k]
    for d in range(3):
        place[3 * k + d], place[3 * o + d] = place[3 * o + d], place[3 * k + d]
