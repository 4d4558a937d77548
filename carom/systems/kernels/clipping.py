"""What of a face or segment is over a face of another body, seen along a direction."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import ALONG, BIAS, FACE_CONE, OVER_EDGE
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import cross


@inlined
def write_loop(hulls, face, v, begin, label, polygon, tag):
    """Write a face's corners, each with the label of the edge that leaves it; return how many there are."""
    count = 0
    for corner in range(hulls.loop_start[face], hulls.loop_start[face + 1]):
        i = 3 * (begin + hulls.loop_vertex[corner])
        polygon[3 * count], polygon[3 * count + 1], polygon[3 * count + 2] = v[i], v[i + 1], v[i + 2]
        tag[count] = label + hulls.loop_edge[corner]
        count += 1
    return count


@inlined
def side_of_edge(hulls, face, corner, v, begin, nx, ny, nz):
    """Return (unit normal, offset) of the plane through a face's edge along n, which points out of the face.

    The plane is OVER_EDGE further out.
    """
    start, stop = hulls.loop_start[face], hulls.loop_start[face + 1]
    following = corner + 1 if corner + 1 < stop else start
    i, j = 3 * (begin + hulls.loop_vertex[corner]), 3 * (begin + hulls.loop_vertex[following])
    x, y, z = cross(v[j] - v[i], v[j + 1] - v[i + 1], v[j + 2] - v[i + 2], nx, ny, nz)
    scale = 1.0 / sqrt(x * x + y * y + z * z)
    x, y, z = x * scale, y * scale, z * scale
    return x, y, z, x * v[i] + y * v[i + 1] + z * v[i + 2] + OVER_EDGE


@inlined
def clip_loop(hulls, face, v, begin, label, nx, ny, nz, polygon, tag, count):
    """Cut a polygon to what is over a face along n (out of the face); return how many corners it has then.

    Sutherland and Hodgman (Ericson 8.3.4) by turns into the halves of ``polygon`` and ``tag``; the result is in the
    first. New corners carry the labels of the edges that cross there.
    """
    here, there = 0, len(tag) // 2
    for corner in range(hulls.loop_start[face], hulls.loop_start[face + 1]):
        x, y, z, offset = side_of_edge(hulls, face, corner, v, begin, nx, ny, nz)
        kept = 0
        for k in range(count):
            i, j = 3 * (here + k), 3 * (here + (k + 1 if k + 1 < count else 0))
            out = x * polygon[i] + y * polygon[i + 1] + z * polygon[i + 2] - offset
            next_out = x * polygon[j] + y * polygon[j + 1] + z * polygon[j + 2] - offset
            if out <= 0.0:
                o = 3 * (there + kept)
                polygon[o], polygon[o + 1], polygon[o + 2] = polygon[i], polygon[i + 1], polygon[i + 2]
                tag[there + kept] = tag[here + k]
                kept += 1
            if (out <= 0.0) != (next_out <= 0.0):
                t = out / (out - next_out)
                o = 3 * (there + kept)
                for d in range(3):
                    polygon[o + d] = polygon[i + d] + t * (polygon[j + d] - polygon[i + d])
                tag[there + kept] = label + hulls.loop_edge[corner] if out <= 0.0 else tag[here + k]
                kept += 1
        here, there, count = there, here, kept
    if here > 0:
        for k in range(count):
            tag[k] = tag[here + k]
            for d in range(3):
                polygon[3 * k + d] = polygon[3 * (here + k) + d]
    return count


@inlined
def clip_segment(hulls, face, v, begin, nx, ny, nz, polygon, tag):
    """Write the ends of what is over a face of the segment between the first two vertices; return 2, or 0 for none."""
    ux, uy, uz = v[3] - v[0], v[4] - v[1], v[5] - v[2]
    low, high = 0.0, 1.0
    for corner in range(hulls.loop_start[face], hulls.loop_start[face + 1]):
        x, y, z, offset = side_of_edge(hulls, face, corner, v, begin, nx, ny, nz)
        out, along = x * v[0] + y * v[1] + z * v[2] - offset, x * ux + y * uy + z * uz
        if along > 0.0:
            high = min(high, -out / along)
        elif along < 0.0:
            low = max(low, -out / along)
        elif out > 0.0:
            return 0
    if low > high:
        return 0
    polygon[0], polygon[1], polygon[2] = v[0] + low * ux, v[1] + low * uy, v[2] + low * uz
    polygon[3], polygon[4], polygon[5] = v[0] + high * ux, v[1] + high * uy, v[2] + high * uz
    tag[0], tag[1] = 1, 2
    return 2


@inlined
def beside_edge(hulls, p, v, begin, gap, nx, ny, nz, px, py, pz, reach, place, gaps, names):
    """Write the ends of what of the segment between the first two vertices lies along an edge of a polyhedron.

    They are ``gap`` apart along n, which leads from the point x of the segment to the polyhedron outside of it. Return
    how many ends are nearer than ``reach`` in that direction, to FACE_CONE; 0 where no edge is beside the segment or
    both ends are farther than x.
    """
    ux, uy, uz = v[3] - v[0], v[4] - v[1], v[5] - v[2]
    length, foremost = ux * ux + uy * uy + uz * uz, nx * px + ny * py + nz * pz + gap + BIAS
    for edge in range(hulls.edge_start[p], hulls.edge_start[p + 1]):
        i, j = 3 * (begin + hulls.edges[edge, 0]), 3 * (begin + hulls.edges[edge, 1])
        if min(nx * v[i] + ny * v[i + 1] + nz * v[i + 2], nx * v[j] + ny * v[j + 1] + nz * v[j + 2]) > foremost:
            continue
        wx, wy, wz = v[j] - v[i], v[j + 1] - v[i + 1], v[j + 2] - v[i + 2]
        x, y, z = cross(ux, uy, uz, wx, wy, wz)
        width, along = wx * wx + wy * wy + wz * wz, ux * wx + uy * wy + uz * wz
        if x * x + y * y + z * z >= ALONG * length * width:
            continue
        dx, dy, dz = v[0] - v[i], v[1] - v[i + 1], v[2] - v[i + 2]
        first = dx * wx + dy * wy + dz * wz
        one, other = -first / along, (width - first) / along
        low, high = max(0.0, min(one, other)), min(1.0, max(one, other))
        if low >= high:
            continue
        found, least = 0, reach
        for end in range(2):
            t = high if end == 1 else low
            s = (first + t * along) / width
            x, y, z = dx + t * ux - s * wx, dy + t * uy - s * wy, dz + t * uz - s * wz
            gaps[found], names[found] = sqrt(x * x + y * y + z * z), 1 + end
            place[3 * found], place[3 * found + 1], place[3 * found + 2] = v[0] + t * ux, v[1] + t * uy, v[2] + t * uz
            least = min(least, gaps[found])
            found += 1 if gaps[found] <= reach and -(nx * x + ny * y + nz * z) >= FACE_CONE * gaps[found] else 0
        if least <= gap + BIAS:
            return found
    return 0
