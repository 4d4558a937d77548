"""Single points of two boxes: where two of their edges come nearest, and the corner nearest to the other box."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.parting import FAR, OTHER, OWN, PLACE, TURN, VIEW, after, along_axis

EDGE_FEATURES = 144  # pairs of the 12 edges of each box


@woven
def crossing_edges(view, edges, nx, ny, nz):
    """Return (whether the nearest points are within both edges, number of the pair, middle) along their normal n.

    ``edges`` are two axes (`widest_edges`); of the four edges along each the foremost towards the other box counts.
    All in the first frame (Ericson, Real-Time Collision Detection, 5.1.8).
    """
    i, j = edges // 3, edges % 3
    ox, oy, oz, number_a, number_b, bit = 0.0, 0.0, 0.0, 4 * i, 4 * j, 1  # o: from the first edge's middle to the other
    for r in range(3):
        if r != i:
            front = along_axis(view, 0, r, nx, ny, nz) >= 0.0
            edge = view[OWN + r] if front else -view[OWN + r]
            number_a += bit if front else 0
            bit = 2
            ox, oy, oz = ox + (edge if r == 0 else 0.0), oy + (edge if r == 1 else 0.0), oz + (edge if r == 2 else 0.0)
    ax, ay, az = ox, oy, oz
    bx, by, bz = view[PLACE], view[PLACE + 1], view[PLACE + 2]
    bit = 1
    for c in range(3):
        if c != j:
            front = along_axis(view, VIEW, c, nx, ny, nz) <= 0.0
            edge = view[OTHER + c] if front else -view[OTHER + c]
            number_b += bit if front else 0
            bit = 2
            bx, by, bz = (
                bx + edge * view[TURN + c],
                by + edge * view[TURN + 3 + c],
                bz + edge * view[TURN + 6 + c],
            )
    ux, uy, uz = view[TURN + j], view[TURN + 3 + j], view[TURN + 6 + j]
    dx, dy, dz = bx - ax, by - ay, bz - az
    along_a, along_b, cosine = along_axis(view, 0, i, dx, dy, dz), dx * ux + dy * uy + dz * uz, view[TURN + 3 * i + j]
    low, high = view[TURN + 3 * after(i) + j], view[TURN + 3 * after(after(i)) + j]
    inverse = 1.0 / (low * low + high * high)
    s, t = (along_a - cosine * along_b) * inverse, (cosine * along_a - along_b) * inverse
    ha, hb = view[OWN + i], view[OTHER + j]
    inside = abs(s) <= ha and abs(t) <= hb
    s, t = min(max(s, -ha), ha), min(max(t, -hb), hb)
    ax, ay, az = ax + (s if i == 0 else 0.0), ay + (s if i == 1 else 0.0), az + (s if i == 2 else 0.0)
    x, y, z = 0.5 * (ax + bx + t * ux), 0.5 * (ay + by + t * uy), 0.5 * (az + bz + t * uz)
    return inside, 12 * number_a + number_b, x, y, z


@inlined
def nearest_corner(view):
    """Return (gap, 8 box + corner, direction, middle) of the corner nearest to the other box, which it is outside of.

    The direction leads from the other box to the corner; both are in the frame of that other box.
    """
    least, number = FAR, 0
    for n in range(16):
        dx, dy, dz, _, _, _ = from_box(view, n)
        squared = dx * dx + dy * dy + dz * dz
        number, least = (n, squared) if squared < least else (number, least)
    gap = sqrt(least)
    dx, dy, dz, x, y, z = from_box(view, number)
    return gap, number, dx / gap, dy / gap, dz / gap, x + 0.5 * dx, y + 0.5 * dy, z + 0.5 * dz


@inlined
def from_box(view, number):
    """Return the way to a corner from the nearest point of the other box, and that point, in the other's frame."""
    at = VIEW if number >= 8 else 0
    a = view[at + OTHER] if number & 1 else -view[at + OTHER]
    b = view[at + OTHER + 1] if number & 2 else -view[at + OTHER + 1]
    c = view[at + OTHER + 2] if number & 4 else -view[at + OTHER + 2]
    x = view[at + PLACE] + a * view[at + TURN] + b * view[at + TURN + 1] + c * view[at + TURN + 2]
    y = view[at + PLACE + 1] + a * view[at + TURN + 3] + b * view[at + TURN + 4] + c * view[at + TURN + 5]
    z = view[at + PLACE + 2] + a * view[at + TURN + 6] + b * view[at + TURN + 7] + c * view[at + TURN + 8]
    px = min(max(x, -view[at + OWN]), view[at + OWN])
    py = min(max(y, -view[at + OWN + 1]), view[at + OWN + 1])
    pz = min(max(z, -view[at + OWN + 2]), view[at + OWN + 2])
    return x - px, y - py, z - pz, px, py, pz
