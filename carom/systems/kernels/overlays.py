"""Overlays: what of one outline lies over another, seen along the contact's normal."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import ALONG, ASKEW, ASKEW_ROUND, OVER_EDGE
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.outlines import LABELS
from carom.systems.kernels.spatial import cross

AHEAD_X, AHEAD_Y, AHEAD_Z = 0.36, 0.48, 0.8  # the end farther along it in the first frame is numbered 2


@inlined
def over_face(
    face, face_tag, corners, plane, polygon, tag, count, on_first, gap, nx, ny, nz, reach, place, gaps, names
):  # fmt: skip
    """Write the points of an outline over a face that are nearer to it than ``reach`` along n; return how many.

    ``polygon`` and ``tag`` have room for twice as many points as both outlines have and are used up (Sutherland and
    Hodgman, Ericson 8.3.4). ``on_first``: the face is of the first body, so that points are moved there. Nothing is
    nearer than ``gap``, for what was let stand over an edge.
    """
    here, there, is_line = 0, len(tag) // 2, count == 2
    facing = plane[0] * nx + plane[1] * ny + plane[2] * nz
    sense = 1.0 if facing > 0.0 else -1.0
    for k in range(corners):
        i, j = 3 * k, 3 * (k + 1 if k + 1 < corners else 0)
        x, y, z = cross(
            face[j] - face[i], face[j + 1] - face[i + 1], face[j + 2] - face[i + 2], sense * nx, sense * ny, sense * nz
        )
        scale = 1.0 / sqrt(x * x + y * y + z * z)
        x, y, z = x * scale, y * scale, z * scale
        offset = x * face[i] + y * face[i + 1] + z * face[i + 2] + OVER_EDGE
        kept = 0
        for a in range(count):
            p, b = 3 * (here + a), a + 1 if a + 1 < count else 0
            q = 3 * (here + b)
            out = x * polygon[p] + y * polygon[p + 1] + z * polygon[p + 2] - offset
            next_out = x * polygon[q] + y * polygon[q + 1] + z * polygon[q + 2] - offset
            if out <= 0.0:
                o = 3 * (there + kept)
                polygon[o], polygon[o + 1], polygon[o + 2] = polygon[p], polygon[p + 1], polygon[p + 2]
                tag[there + kept] = tag[here + a]
                kept += 1
            if (out <= 0.0) != (next_out <= 0.0) and not (is_line and a > 0):
                t = out / (out - next_out)
                o = 3 * (there + kept)
                for d in range(3):
                    polygon[o + d] = polygon[p + d] + t * (polygon[q + d] - polygon[p + d])
                if is_line:  # which keeps the names of its ends
                    tag[there + kept] = tag[here + b] if out <= 0.0 else tag[here + a]
                else:
                    tag[there + kept] = face_tag[k] if out <= 0.0 else tag[here + a]
                kept += 1
        here, there, count = there, here, kept
    found = 0
    for a in range(count):
        p = 3 * (here + a)
        above = plane[0] * polygon[p] + plane[1] * polygon[p + 1] + plane[2] * polygon[p + 2] - plane[3]
        apart = above / abs(facing)
        if apart > reach:
            continue
        back = apart if on_first else 0.0
        before, after = tag[here + (a - 1 if a > 0 else count - 1)], tag[here + a]
        names[found] = 1 + after if is_line else 1 + min(before, after) * 2 * LABELS + max(before, after)
        gaps[found] = max(apart, gap)
        place[3 * found] = polygon[p] - back * nx
        place[3 * found + 1] = polygon[p + 1] - back * ny
        place[3 * found + 2] = polygon[p + 2] - back * nz
        found += 1
    return found


@inlined
def beside_line(line, other, round_one, round_other, gap, nx, ny, nz, reach, place, gaps, names):
    """Write the ends of what of two lines, first and second body's, is side by side; return 0 where they miss.

    Seen along n that is where they are within ASKEW of the length beside each other. Lines on round sides, of these
    radii, may be farther, since the sides fall away from each other as slowly as arcs, and meet between the lines.
    """
    ux, uy, uz = line[3] - line[0], line[4] - line[1], line[5] - line[2]
    vx, vy, vz = other[3] - other[0], other[4] - other[1], other[5] - other[2]
    cx, cy, cz = cross(ux, uy, uz, vx, vy, vz)
    length = ux * ux + uy * uy + uz * uz
    if cx * cx + cy * cy + cz * cz > ALONG * length * (vx * vx + vy * vy + vz * vz):
        return 0
    along = ux * vx + uy * vy + uz * vz
    ox, oy, oz = other[0] - line[0], other[1] - line[1], other[2] - line[2]
    begin = (ux * ox + uy * oy + uz * oz) / length
    low, high = begin, begin + along / length
    if low > high:
        low, high = high, low
    low, high = max(low, 0.0), min(high, 1.0)
    sx, sy, sz = cross(nx, ny, nz, ux, uy, uz)
    squared, radius, share = sx * sx + sy * sy + sz * sz, round_one + round_other, 0.0
    slack = max(ASKEW * squared, ASKEW_ROUND * radius * sqrt(squared))
    turned = (sx * vx + sy * vy + sz * vz) * length / along  # how far the other line moves aside along the first
    beside = sx * ox + sy * oy + sz * oz - begin * turned
    if abs(turned) > slack:
        first, last = (-slack - beside) / turned, (slack - beside) / turned
        low, high = max(low, min(first, last)), min(high, max(first, last))
    elif abs(beside) > 2.0 * slack:
        return 0
    if low >= high:
        return 0
    found, ahead = 0, AHEAD_X * ux + AHEAD_Y * uy + AHEAD_Z * uz > 0.0
    for k in range(2):
        s = low if k == 0 else high
        t = (s - begin) * length / along
        x, y, z = line[0] + s * ux, line[1] + s * uy, line[2] + s * uz
        apart = nx * (other[0] + t * vx - x) + ny * (other[1] + t * vy - y) + nz * (other[2] + t * vz - z)
        if radius > 0.0:
            aside = (beside + s * turned) / squared
            apart, share = apart + 0.5 * aside * aside * squared / radius, aside * round_one / radius
        if apart <= reach:
            gaps[found], names[found] = max(apart, gap), 1 + k if ahead else 2 - k
            place[3 * found], place[3 * found + 1] = x + share * sx, y + share * sy
            place[3 * found + 2] = z + share * sz
            found += 1
    return found
