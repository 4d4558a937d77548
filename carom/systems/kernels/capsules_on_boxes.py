"""Narrow phase of capsules against boxes: a segment in the frame of the box, grown by the radius."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import ALONG as LYING_ALONG
from carom.systems.constants import BIAS, FACE_CONE, LEAST_PART
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.frames import placed, turned, turned_back
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.parting import after
from carom.systems.kernels.segment_and_box import (
    ALONG,
    HALF,
    MIDDLE,
    WAY,
    above,
    beyond,
    gap_beyond,
    gap_from_edge,
    longest,
    nearest_to_box,
    way_out,
    within_faces,
)
from carom.systems.kernels.writing import write_point

# Features. The two points over face f (x, y, z; the upper faces are the odd ones) are 2 f and 2 f + 1, a lone point 12,
# the two along edge e from 13 + 2 e on; there are four edges along x, then along y and z.
ALONE, EDGES = 12, 13


@shared("start", "count", "apart", "feature", "normal", "depth", "point", makes_arrays=True)
def measure_capsules_on_boxes(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of a capsule and a box.

    Over a face within FACE_CONE of the way out there are two points, at the ends of what of the segment lies over it;
    beside an edge that it lies along, at the ends of what is beside it; else there is one. A segment inside the box
    leaves it by the least of six ways: three out of faces, three across itself and an edge.
    """
    own = np.empty(12)
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for k in range(begin, end):
        p, i, o = which[k], first[k], second[k]
        start[p], reach = taken, reaches[p]
        radius, half = size[i, 0], 0.5 * size[i, 1]
        dx, dy, dz = position[i, 0] - position[o, 0], position[i, 1] - position[o, 1], position[i, 2] - position[o, 2]
        own[MIDDLE], own[MIDDLE + 1], own[MIDDLE + 2] = turned_back(rotation, o, dx, dy, dz)
        ux, uy, uz = turned(rotation, i, 0.0, 1.0, 0.0)
        own[ALONG], own[ALONG + 1], own[ALONG + 2] = turned_back(rotation, o, ux, uy, uz)
        for d in range(3):
            own[HALF + d] = 0.5 * size[o, d]
        s = nearest_to_box(own, half)
        gap = gap_beyond(own, s)
        apart[p] = gap - radius
        if not apart[p] <= reach:
            continue
        if gap > LEAST_PART:
            face_the_box(own, s, gap)
        else:
            gap, s = way_out(own, half)
        axis, edge = longest(own, WAY), longest(own, ALONG)
        side, corner = 1.0 if own[WAY + axis] > 0.0 else -1.0, corner_of(own, edge)
        low, high, two, over = s, s, False, abs(own[WAY + axis]) >= FACE_CONE
        if over:
            low, high = within_faces(own, after(axis), -half, half)
            low, high = within_faces(own, after(after(axis)), low, high)
            two = low < high and min(above(own, axis, side, low), above(own, axis, side, high)) <= gap + BIAS
        elif gap > BIAS and 1.0 - own[ALONG + edge] * own[ALONG + edge] < LYING_ALONG:
            low, high = within_faces(own, edge, -half, half)
            two = low < high and min(gap_from_edge(own, edge, low), gap_from_edge(own, edge, high)) <= gap + BIAS
        for end in range(2 if two else 1):
            name = ALONE
            if two:
                s = high if end == 1 else low
                if over:
                    name, gap = 4 * axis + (2 if side > 0.0 else 0) + end, above(own, axis, side, s)
                    for d in range(3):
                        own[WAY + d] = side if d == axis else 0.0
                else:
                    name, gap = EDGES + 8 * edge + 2 * corner + end, gap_from_edge(own, edge, s)
                    face_the_box(own, s, gap)
                    own[WAY + edge] = 0.0
            if gap - radius > reach:
                continue
            nx, ny, nz = turned(rotation, o, own[WAY], own[WAY + 1], own[WAY + 2])
            lever = 0.5 * (gap + radius)
            x, y, z = placed(position, rotation, i, 0.0, s, 0.0)
            write_point(
                taken, name, gap - radius, -nx, -ny, -nz, x - lever * nx, y - lever * ny, z - lever * nz,
                feature, normal, depth, point,
            )  # fmt: skip
            taken += 1
        count[p] = taken - start[p]


@inlined
def face_the_box(own, s, gap):
    """Write the way from the box to the point s of the segment, ``gap`` away."""
    for d in range(3):
        own[WAY + d] = beyond(own, d, s) / gap


@inlined
def corner_of(own, edge):
    """Return the number of the box's edge, of the four along an axis, that is foremost along the way out."""
    return (1 if own[WAY + after(edge)] > 0.0 else 0) + (2 if own[WAY + after(after(edge))] > 0.0 else 0)
