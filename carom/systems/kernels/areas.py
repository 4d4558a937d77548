"""The area in which two polyhedra meet: where the faces turned to each other lie one over the other."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, FLAT_COSINE
from carom.systems.kernels.clipping import beside_edge, clip_loop, clip_segment, side_of_edge, write_loop
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.polyhedra import POINT, SEGMENT, face_towards


@inlined
def points_of_area(
    hulls, p, q, v, middle, end, planes, split, gap, nx, ny, nz, px, py, pz, reach,
    labels_p, labels_q, labels, polygon, tag, place, gaps, names,
):  # fmt: skip
    """Write the points of the area where polyhedra p and q, ``gap`` apart along n, are nearer than ``reach``.

    ``place`` takes the points on p, ``gaps`` how far q is from there, ``names`` numbers from the two edges whose lines
    meet in a point: the same whichever face is clipped, and 1 and 2 for the ends of a segment; further corners over the
    other's face are named behind all of those. ``split`` is where the faces of q begin in ``planes``, as ``middle`` is
    for vertices; p's edges are labelled from ``labels_p``. Where the normal is far from that of a face, and where
    rounding cut away the deepest, the point x on p is one, named 0.
    """
    found, corners, reference, least, both = 0, 0, 0, 1e300, False
    if p != POINT:
        on_p, cosine_p = face_towards(hulls, p, v, 0, middle, planes, 0, nx, ny, nz)
        on_q, cosine_q = face_towards(hulls, q, v, middle, end, planes, split, -nx, -ny, -nz)
        face_p, face_q = hulls.face_start[p] + on_p, hulls.face_start[q] + on_q
        if max(cosine_p, cosine_q) < FLAT_COSINE:
            if p == SEGMENT and gap > BIAS:
                found = beside_edge(hulls, q, v, middle, gap, nx, ny, nz, px, py, pz, reach, place, gaps, names)
                least = gap if found > 0 else least
        elif p == SEGMENT:
            reference = split + on_q
            corners = clip_segment(hulls, face_q, v, middle, -nx, -ny, -nz, polygon, tag)
        elif cosine_p >= cosine_q - BIAS:
            reference, both = on_p, True
            corners = write_loop(hulls, face_q, v, middle, labels_q, polygon, tag)
            corners = clip_loop(hulls, face_p, v, 0, labels_p, nx, ny, nz, polygon, tag, corners)
        else:
            reference, both = split + on_q, True
            corners = write_loop(hulls, face_p, v, 0, labels_p, polygon, tag)
            corners = clip_loop(hulls, face_q, v, middle, labels_q, -nx, -ny, -nz, polygon, tag, corners)
    for c in range(corners):
        f, i = 4 * reference, 3 * c
        above = planes[f] * polygon[i] + planes[f + 1] * polygon[i + 1] + planes[f + 2] * polygon[i + 2]
        along = planes[f] * nx + planes[f + 1] * ny + planes[f + 2] * nz
        apart = (above - planes[f + 3]) / abs(along)
        back = apart if along > 0.0 else 0.0  # from a point on q to p
        gaps[found] = max(apart, gap)  # not deeper than the pair, for what was let stand over an edge
        if gaps[found] > reach:
            continue
        before, after = tag[c - 1 if c > 0 else corners - 1], tag[c]
        names[found] = after if p == SEGMENT else 1 + min(before, after) * labels + max(before, after)
        place[3 * found] = polygon[i] - back * nx
        place[3 * found + 1] = polygon[i + 1] - back * ny
        place[3 * found + 2] = polygon[i + 2] - back * nz
        least = min(least, gaps[found])
        found += 1
    if both and reference < split:
        found = corners_over_face(
            hulls, face_p, v, 0, face_q, middle, end, planes, reference, gap, nx, ny, nz, reach,
            1 + labels * labels + labels_q, place, gaps, names, found,
        )  # fmt: skip
    elif both:
        found = corners_over_face(
            hulls, face_q, v, middle, face_p, 0, middle, planes, reference, gap, nx, ny, nz, reach,
            1 + labels * labels + labels_p, place, gaps, names, found,
        )  # fmt: skip
    if least > gap + 2.0 * BIAS:
        gaps[found], names[found] = gap, 0
        place[3 * found], place[3 * found + 1], place[3 * found + 2] = px, py, pz
        found += 1
    return found


@inlined
def corners_over_face(
    hulls, face, v, begin, other, first, end, planes, plane, gap, nx, ny, nz, reach, name, place, gaps, names, found
):  # fmt: skip
    """Add the corners of a polyhedron that are over a face of another, but for those of one of its own faces.

    That is the ``other``, which is turned to the face; a body that rolls on comes down to its next corners. Return how
    many points there are; corners are named from ``name`` on.
    """
    f = 4 * plane
    along = planes[f] * nx + planes[f + 1] * ny + planes[f + 2] * nz
    out = 1.0 if along > 0.0 else -1.0
    for c in range(first, end):
        i = 3 * c
        above = planes[f] * v[i] + planes[f + 1] * v[i + 1] + planes[f + 2] * v[i + 2]
        apart, over = (above - planes[f + 3]) / abs(along), True
        if apart > reach:
            continue
        for corner in range(hulls.loop_start[other], hulls.loop_start[other + 1]):
            over &= hulls.loop_vertex[corner] != c - first
        for corner in range(hulls.loop_start[face], hulls.loop_start[face + 1] if over else 0):
            x, y, z, offset = side_of_edge(hulls, face, corner, v, begin, out * nx, out * ny, out * nz)
            over &= x * v[i] + y * v[i + 1] + z * v[i + 2] <= offset
        if over:
            back = apart if along > 0.0 else 0.0
            gaps[found], names[found] = max(apart, gap), name + c - first
            place[3 * found], place[3 * found + 1] = v[i] - back * nx, v[i + 1] - back * ny
            place[3 * found + 2] = v[i + 2] - back * nz
            found += 1
    return found
