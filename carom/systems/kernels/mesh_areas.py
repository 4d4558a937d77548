"""Where a face of a solid and a triangle of a mesh lie one over the other."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, GORGE, OVER_EDGE, SAME_NORMAL
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.mesh_points import add_point
from carom.systems.kernels.mesh_surface import is_nearest_beneath
from carom.systems.kernels.mesh_tree import TRIANGLE
from carom.systems.kernels.spatial import cross

MOST_CORNERS = 64  # names of points below it are those of the solid's corners
INNER = 8  # bit of what lies within a triangle, on no edge of it


@inlined
def corners_beyond(polygon, here, count, x, y, z, offset):
    """Return how many of a polygon's corners are not under a plane."""
    beyond = 0
    for i in range(3 * here, 3 * (here + count), 3):
        beyond += 1 if x * polygon[i] + y * polygon[i + 1] + z * polygon[i + 2] - offset > 0.0 else 0
    return beyond


@inlined
def cut(polygon, tag, here, there, count, x, y, z, offset, bit):
    """Cut a polygon from ``here`` to what is under a plane, into ``there``; return how many corners it has then.

    Sutherland and Hodgman (Ericson 8.3.4). Two tags per corner: the edges of the triangle it lies on, as bits, and the
    corner of the solid's face that the edge leaving it started at. New corners get ``bit``; 0: of both their sides.
    """
    kept = 0
    for k in range(count):
        following = k + 1 if k + 1 < count else 0
        i, j = 3 * (here + k), 3 * (here + following)
        out = x * polygon[i] + y * polygon[i + 1] + z * polygon[i + 2] - offset
        next_out = x * polygon[j] + y * polygon[j + 1] + z * polygon[j + 2] - offset
        if out <= 0.0:
            o = there + kept
            for d in range(3):
                polygon[3 * o + d] = polygon[i + d]
            tag[2 * o], tag[2 * o + 1] = tag[2 * (here + k)], tag[2 * (here + k) + 1]
            kept += 1
        if (out <= 0.0) != (next_out <= 0.0):
            share = out / (out - next_out)
            o = there + kept
            for d in range(3):
                polygon[3 * o + d] = polygon[i + d] + share * (polygon[j + d] - polygon[i + d])
            tag[2 * o] = tag[2 * (here + k)] & tag[2 * (here + following)] | bit
            tag[2 * o + 1] = tag[2 * (here + k) + 1]
            kept += 1
    return kept


@inlined
def beyond_bottom(v, loop_vertex, begin, stop, triangles, links, vertices, t, edge, x, y, z, reach, close, near):
    """Return how far (m) corners of a face that still count are beyond the edge of a triangle in which a valley ends.

    Those over its other side, within ``reach`` of the edge and of the triangle's plane, may be over this one the next
    moment, unless both have one manifold; in the ground they are held by both, behind both. In the wedge beneath they
    are over neither side: there no other of the ``near`` triangles that are ``close`` is nearer. ``x`` is the way out
    of the triangle, along which it is measured.
    """
    a, w = TRIANGLE * t, 3 * links[8 * t + 3 + edge]
    i, j = a + 3 * edge, a + 3 * ((edge + 1) % 3)
    nx, ny, nz = triangles[a + 9], triangles[a + 10], triangles[a + 11]
    ux, uy, uz = triangles[i] - triangles[j], triangles[i + 1] - triangles[j + 1], triangles[i + 2] - triangles[j + 2]
    rx, ry, rz = vertices[w] - triangles[i], vertices[w + 1] - triangles[i + 1], vertices[w + 2] - triangles[i + 2]
    mx, my, mz = cross(ux, uy, uz, rx, ry, rz)
    bent = nx * mx + ny * my + nz * mz < SAME_NORMAL * sqrt(mx * mx + my * my + mz * mz)
    ox, oy, oz = cross(ux, uy, uz, mx, my, mz)  # the ways out of the other side, over its edges
    px, py, pz = cross(rx, ry, rz, mx, my, mz)
    farthest = 0.0
    for k in range(begin, stop):
        c = 3 * loop_vertex[k]
        qx, qy, qz = v[c] - triangles[i], v[c + 1] - triangles[i + 1], v[c + 2] - triangles[i + 2]
        gap, out = nx * qx + ny * qy + nz * qz, x * qx + y * qy + z * qz
        if out <= farthest:
            continue
        counts = bent and max(gap, out) <= reach and (gap >= 0.0 or mx * qx + my * qy + mz * qz <= 0.0)
        counts &= ox * qx + oy * qy + oz * qz <= 0.0 and px * qx + py * qy + pz * qz <= 0.0
        counts &= (ox + px) * (qx - rx) + (oy + py) * (qy - ry) + (oz + pz) * (qz - rz) >= 0.0
        if out <= -GORGE * gap and not counts:
            counts = is_nearest_beneath(triangles, links, close, near, t, v[c], v[c + 1], v[c + 2])
        if counts:
            farthest = out
    return farthest


@woven
def points_over_triangle(
    v, loop_vertex, begin, stop, triangles, links, vertices, t, radius, reach, close, near,
    polygon, tag, room, points, names, found,
):  # fmt: skip
    """Add the points of a solid's face (loop entries from ``begin`` on) that are over a triangle; return how many.

    Those on the triangle's inactive edges are left out: the area goes on there. Corners in a valley count as over both
    of its sides (`beyond_bottom`).
    """
    a = TRIANGLE * t
    nx, ny, nz = triangles[a + 9], triangles[a + 10], triangles[a + 11]
    height = nx * triangles[a] + ny * triangles[a + 1] + nz * triangles[a + 2]
    count = stop - begin
    for k in range(count):
        i = loop_vertex[begin + k]
        for d in range(3):
            polygon[3 * k + d] = v[3 * i + d]
        tag[2 * k], tag[2 * k + 1] = 0, i
    active, source = links[8 * t + 6], links[8 * t + 7]
    here, there = 0, room
    for k in range(3):
        i, j = a + 3 * k, a + 3 * ((k + 1) % 3)
        x, y, z = cross(
            triangles[j] - triangles[i], triangles[j + 1] - triangles[i + 1], triangles[j + 2] - triangles[i + 2],
            nx, ny, nz,
        )  # fmt: skip
        scale = triangles[a + 12 + k]
        x, y, z = x * scale, y * scale, z * scale
        offset = x * triangles[i] + y * triangles[i + 1] + z * triangles[i + 2] + OVER_EDGE
        beyond = corners_beyond(polygon, here, count, x, y, z, offset)
        if beyond > 0 and not active & (1 << k):
            far = radius + reach
            offset += beyond_bottom(
                v, loop_vertex, begin, stop, triangles, links, vertices, t, k, x, y, z, far, close, near
            )
            beyond = corners_beyond(polygon, here, count, x, y, z, offset)
        if beyond == count:
            return found
        if beyond > 0:
            count = cut(polygon, tag, here, there, count, x, y, z, offset, 1 << k)
            here, there = there, here
    for k in range(count):
        bits = tag[2 * (here + k)]
        i = 3 * (here + k)
        gap = nx * polygon[i] + ny * polygon[i + 1] + nz * polygon[i + 2] - height
        if gap - radius > reach or (bits != 0 and bits & active == 0):
            continue
        name = tag[2 * (here + k) + 1]
        if bits != 0:
            name = MOST_CORNERS + (16 * source + bits) * MOST_CORNERS + name
        half = 0.5 * (gap + radius)
        found = add_point(
            points, names, found, nx, ny, nz,
            polygon[i] - half * nx, polygon[i + 1] - half * ny, polygon[i + 2] - half * nz, gap - radius, name,
        )  # fmt: skip
    return found


@woven
def points_over_face(
    v, loop_vertex, begin, stop, x, y, z, height, triangles, links, t, least, reach,
    polygon, tag, room, points, names, found,
):  # fmt: skip
    """Add the points of a triangle that are over a solid's face with outward normal x; return how many.

    Those on inactive edges are left out, but for the deepest, at ``least``; the face's corners are not.
    """
    a = TRIANGLE * t
    for k in range(3):
        for d in range(3):
            polygon[3 * k + d] = triangles[a + 3 * k + d]
        tag[2 * k], tag[2 * k + 1] = 1 << k | 1 << (k + 2) % 3, k
    here, there, count = 0, room, 3
    for corner in range(begin, stop):
        following = corner + 1 if corner + 1 < stop else begin
        i, j = 3 * loop_vertex[corner], 3 * loop_vertex[following]
        sx, sy, sz = cross(v[j] - v[i], v[j + 1] - v[i + 1], v[j + 2] - v[i + 2], x, y, z)
        scale = 1.0 / sqrt(sx * sx + sy * sy + sz * sz)
        sx, sy, sz = sx * scale, sy * scale, sz * scale
        offset = sx * v[i] + sy * v[i + 1] + sz * v[i + 2] + OVER_EDGE
        beyond = corners_beyond(polygon, here, count, sx, sy, sz, offset)
        if beyond == count:
            return found
        if beyond > 0:
            count = cut(polygon, tag, here, there, count, sx, sy, sz, offset, 0)
            here, there = there, here
    active, source = links[8 * t + 6], links[8 * t + 7]
    for k in range(count):
        bits = tag[2 * (here + k)]
        i = 3 * (here + k)
        gap = x * polygon[i] + y * polygon[i + 1] + z * polygon[i + 2] - height
        if gap > reach or (bits != 0 and bits & active == 0 and gap > least + BIAS):
            continue
        half = 0.5 * gap
        found = add_point(
            points, names, found, -x, -y, -z,
            polygon[i] - half * x, polygon[i + 1] - half * y, polygon[i + 2] - half * z, gap,
            MOST_CORNERS + (16 * source + INNER + bits) * MOST_CORNERS + k,
        )  # fmt: skip
    return found
