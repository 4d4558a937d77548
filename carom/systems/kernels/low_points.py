"""Low points: of a contact area, those that are lower than what the points that stand for it span."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import AS_LOW, BETTER, BIAS, LOWER, ROLLED_ONTO
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.reduction import (
    MOST_POINTS,
    SPANNING,
    alternate,
    extend_area,
    put_deepest_first,
    span_area,
    span_roughly,
    swap,
)
from carom.systems.kernels.spatial import cross

FAR = 1e300  # m


@inlined
def reduce_lows(place, gaps, names, count, nx, ny, nz):
    """Do what `reduce_area` does for bodies that may roll onto further corners: with those that are lower than others.

    A corner within what others span that is left out is what such a body rolls onto, and sinks in.
    """
    if count <= SPANNING:
        return count
    put_deepest_first(place, gaps, names, count)
    kept = span_low(place, gaps, names, count, nx, ny, nz, BIAS, FAR)
    if kept > SPANNING:
        alternate(names, kept)
    return kept


@inlined
def reduce_round(place, gaps, names, count, nx, ny, nz):
    """Do what `reduce_area` does for rims: where they lean, with the lowest two (ROLLED_ONTO) of the others.

    Between points that are spread all around, bodies that roll on their rim would sink in by what these leave out.
    """
    if count <= SPANNING:
        return count
    put_deepest_first(place, gaps, names, count)
    kept, highest = span_area(place, gaps, names, count, nx, ny, nz, BIAS), gaps[0]
    for k in range(1, kept):
        highest = max(highest, gaps[k])
    if highest > gaps[0] + AS_LOW:
        room = min(MOST_POINTS, max(kept, SPANNING + ROLLED_ONTO))
        kept = extend_lowest(place, gaps, names, kept, room, count, nx, ny, nz, BIAS, FAR)
    if kept > SPANNING:
        alternate(names, kept)
    return kept


@inlined
def span_low(place, gaps, which, count, nx, ny, nz, least, near):
    """Do what `span_area` does, but of eight points those come first that are lower than what four span.

    Those bear. On land whose bumps are many and small all around an area is touched, and all but nothing within it.
    Of those that do not touch there are more than four up to a gap that is ``near``.
    """
    kept = span_roughly(place, gaps, which, count, nx, ny, nz, least)
    found = with_low_ones(place, gaps, which, kept, count, nx, ny, nz, least)
    low = found - kept
    if found < min(MOST_POINTS, count):
        for k in range(low - 1, -1, -1):
            swap(kept + k, count - low + k, place, gaps, which)
        alike = min(near, max(gaps[0], 0.0) + AS_LOW)
        kept = extend_area(place, gaps, which, kept, MOST_POINTS - low, count - low, nx, ny, nz, least, alike)
        kept = extend_lowest(place, gaps, which, kept, MOST_POINTS - low, count - low, nx, ny, nz, least, near)
        for k in range(low):
            swap(kept + k, count - low + k, place, gaps, which)
    return kept + low


@inlined
def extend_lowest(place, gaps, which, kept, room, count, nx, ny, nz, least, near):
    """Do what `extend_area` does, but the lowest points first, whatever area they add."""
    last = count
    while kept < min(room, last):
        lowest = kept
        for k in range(kept + 1, last):
            lowest = k if gaps[k] < gaps[lowest] else lowest
        if gaps[lowest] > near:
            break
        wider = extend_area(place, gaps, which, kept, kept + 1, last, nx, ny, nz, least, gaps[lowest])
        if wider == kept:
            last -= 1
            swap(lowest, last, place, gaps, which)
        kept = wider
    return kept


@inlined
def with_low_ones(place, gaps, which, found, count, nx, ny, nz, least):
    """Move points that are lower than what those ``found`` span behind them, up to eight in all; return how many.

    Again and again the lowest. Where all that is found bears, the others are within the ground: left out until they
    overlap, a body would sink onto them, be lifted off them, and rock for ever.
    """
    while found < MOST_POINTS:
        lowest, most = -1, LOWER * least
        for k in range(found, count):
            lower = height_over(place, gaps, found, k, nx, ny, nz, least) - gaps[k]
            lowest, most = (k, lower * (1.0 + BETTER)) if lower > most else (lowest, most)
        if lowest < 0:
            break
        swap(found, lowest, place, gaps, which)
        found += 1
    return found


@inlined
def height_over(place, gaps, found, k, nx, ny, nz, least):
    """Return the least gap that the points ``found`` leave at the place of point k, seen along n.

    That is the lowest of the lines and triangles between them that it is in, to ``least``; -1e300 where it is in none.
    """
    highest = -1e300
    for i in range(found):
        highest = max(highest, gaps[i])
    if gaps[k] >= highest:
        return -1e300
    height = 1e300
    x, y, z = place[3 * k], place[3 * k + 1], place[3 * k + 2]
    for i in range(found):
        ax, ay, az = place[3 * i] - x, place[3 * i + 1] - y, place[3 * i + 2] - z
        for j in range(i + 1, found):
            bx, by, bz = place[3 * j] - x, place[3 * j + 1] - y, place[3 * j + 2] - z
            ux, uy, uz = bx - ax, by - ay, bz - az
            squared, along = ux * ux + uy * uy + uz * uz, -(ax * ux + ay * uy + az * uz)
            third = area_between(nx, ny, nz, ax, ay, az, bx, by, bz)
            if third * third <= least * least * squared and 0.0 <= along <= squared:
                height = min(height, gaps[i] + along / squared * (gaps[j] - gaps[i]))
            for o in range(j + 1, found):
                cx, cy, cz = place[3 * o] - x, place[3 * o + 1] - y, place[3 * o + 2] - z
                first = area_between(nx, ny, nz, bx, by, bz, cx, cy, cz)
                second = area_between(nx, ny, nz, cx, cy, cz, ax, ay, az)
                whole = first + second + third
                if first * whole > 0.0 and second * whole > 0.0 and third * whole > 0.0:
                    height = min(height, (first * gaps[i] + second * gaps[j] + third * gaps[o]) / whole)
    return height if height < 1e300 else -1e300


@inlined
def area_between(nx, ny, nz, ax, ay, az, bx, by, bz):
    """Return the area of the parallelogram of a and b seen against n, negative where it turns the other way."""
    x, y, z = cross(ax, ay, az, bx, by, bz)
    return nx * x + ny * y + nz * z
