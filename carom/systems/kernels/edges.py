"""Single points of two boxes: where two of their edges come nearest, and the corner nearest to the other box."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.parting import FAR, OTHER, OWN, PLACE, TURN, VIEW, after

EDGE_FEATURES = 144  # pairs of the 12 edges of each box


@woven
def edge_normal(view, lane, edges, way):
    """Write the common normal of two edges (`part`) in the first frame, towards the second box."""
    i, j = edges // 3, edges % 3
    i1, i2 = after(i), after(after(i))
    low, high = view[TURN + 3 * i1 + j, lane], view[TURN + 3 * i2 + j, lane]
    scale = 1.0 / sqrt(low * low + high * high)
    scale = -scale if view[PLACE + i2, lane] * low < view[PLACE + i1, lane] * high else scale
    way[i], way[i1], way[i2] = 0.0, -scale * high, scale * low


@woven
def along_other(view, lane, axis, way):
    """Return the component along an axis of the second box, of a direction in the first frame."""
    return (
        way[0] * view[TURN + axis, lane] + way[1] * view[TURN + 3 + axis, lane] + way[2] * view[TURN + 6 + axis, lane]
    )


@woven
def crossing_edges(view, lane, edges, way, place):
    """Write the middle between two edges where they come nearest; return (whether within both, number of the pair).

    ``edges`` are two axes (`part`), ``way`` their common normal; of the four edges along each axis the foremost towards
    the other box counts. All in the first frame (Ericson, Real-Time Collision Detection, 5.1.8), its axes in the order
    i, i1, i2.
    """
    i, j = edges // 3, edges % 3
    i1, i2, j1, j2 = after(i), after(after(i)), after(j), after(after(j))
    row, row1, row2 = TURN + 3 * i, TURN + 3 * i1, TURN + 3 * i2
    a1, a2, b1, b2 = view[OWN + i1, lane], view[OWN + i2, lane], view[OTHER + j1, lane], view[OTHER + j2, lane]
    a1, a2 = a1 if way[i1] >= 0.0 else -a1, a2 if way[i2] >= 0.0 else -a2
    b1 = b1 if along_other(view, lane, j1, way) <= 0.0 else -b1
    b2 = b2 if along_other(view, lane, j2, way) <= 0.0 else -b2
    d = (
        view[PLACE + i, lane] + b1 * view[row + j1, lane] + b2 * view[row + j2, lane]
    )  # from the one middle to the other
    d1 = view[PLACE + i1, lane] + b1 * view[row1 + j1, lane] + b2 * view[row1 + j2, lane] - a1
    d2 = view[PLACE + i2, lane] + b1 * view[row2 + j1, lane] + b2 * view[row2 + j2, lane] - a2
    u, u1, u2 = view[row + j, lane], view[row1 + j, lane], view[row2 + j, lane]
    along, inverse = d * u + d1 * u1 + d2 * u2, 1.0 / (u1 * u1 + u2 * u2)
    s, t = (d - u * along) * inverse, (u * d - along) * inverse
    half, other = view[OWN + i, lane], view[OTHER + j, lane]
    inside = (abs(s) <= half) & (abs(t) <= other)
    s, t = min(max(s, -half), half), min(max(t, -other), other)
    place[i], place[i1], place[i2] = 0.5 * (s + d + t * u), a1 + 0.5 * (d1 + t * u1), a2 + 0.5 * (d2 + t * u2)
    first = 4 * i + (1 if a1 > 0.0 else 0) + (2 if a2 > 0.0 else 0)
    return inside, 12 * first + 4 * j + (1 if b1 > 0.0 else 0) + (2 if b2 > 0.0 else 0)


@inlined
def nearest_corner(view, lane, way, place):
    """Find the corner nearest to the other box, which it is outside of; return (8 box + corner, gap).

    Write the direction from the other box to the corner, and the middle between; both are in the frame of the other.
    """
    least, number = FAR, 0
    for n in range(16):
        dx, dy, dz, _, _, _ = from_box(view, lane, n)
        squared = dx * dx + dy * dy + dz * dz
        number, least = (n, squared) if squared < least else (number, least)
    gap = sqrt(least)
    dx, dy, dz, x, y, z = from_box(view, lane, number)
    way[0], way[1], way[2] = dx / gap, dy / gap, dz / gap
    place[0], place[1], place[2] = x + 0.5 * dx, y + 0.5 * dy, z + 0.5 * dz
    return number, gap


@inlined
def from_box(view, lane, number):
    """Return the way to a corner from the nearest point of the other box, and that point, in the other's frame."""
    at = VIEW if number >= 8 else 0
    a, b, c = view[at + OTHER, lane], view[at + OTHER + 1, lane], view[at + OTHER + 2, lane]
    a, b, c = a if number & 1 else -a, b if number & 2 else -b, c if number & 4 else -c
    x, px = seen(view, lane, at, 0, a, b, c)
    y, py = seen(view, lane, at, 1, a, b, c)
    z, pz = seen(view, lane, at, 2, a, b, c)
    return x - px, y - py, z - pz, px, py, pz


@inlined
def seen(view, lane, at, d, a, b, c):
    """Return where a point of the other box is along an axis, and the nearest place to it in the own box."""
    row = at + TURN + 3 * d
    x = view[at + PLACE + d, lane] + a * view[row, lane] + b * view[row + 1, lane] + c * view[row + 2, lane]
    return x, min(max(x, -view[at + OWN + d, lane]), view[at + OWN + d, lane])
