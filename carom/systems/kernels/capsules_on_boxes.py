"""Narrow phase of capsules against boxes: a segment in the frame of the box, grown by the radius."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, FACE_CONE, LEAST_PART, PARALLEL_EDGES
from carom.systems.kernels.frames import placed, turned, turned_back
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.writing import write_point

FAR = 1e300
ALONE = 12  # feature; the two points over face f (x, y, z; the upper faces are the odd ones) are 2 f and 2 f + 1
MIDDLE, ALONG, HALF, WAY = 0, 3, 6, 9  # of the scratch: the segment's middle and direction, half edges, the way out


@kernel("start", "count", "feature", "normal", "depth", "point")
def measure_capsules_on_boxes(
    which, first, second, reaches, taken, shape, size, position, rotation, geometry, hulls, meshes,
    start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of a capsule and a box; return how many points are taken now.

    Over a face within FACE_CONE of the way out there are two points, at the ends of what of the segment lies over it;
    else there is one. A segment inside the box leaves it by the least of six ways: three out of faces, three across
    itself and an edge.
    """
    own = np.empty(12)
    for k in range(len(which)):
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
        nx, ny, nz = beyond(own, 0, s), beyond(own, 1, s), beyond(own, 2, s)
        gap = sqrt(nx * nx + ny * ny + nz * nz)
        if not gap - radius <= reach:
            continue
        if gap > LEAST_PART:
            own[WAY], own[WAY + 1], own[WAY + 2] = nx / gap, ny / gap, nz / gap
        else:
            gap, s = way_out(own, half)
        axis = 0
        for d in range(1, 3):
            if abs(own[WAY + d]) > abs(own[WAY + axis]):
                axis = d
        low, high, two = s, s, False
        side = 1.0 if own[WAY + axis] > 0.0 else -1.0
        if abs(own[WAY + axis]) >= FACE_CONE:
            low, high = over_face(own, half, axis)
            two = low < high and min(above(own, axis, side, low), above(own, axis, side, high)) <= gap + BIAS
        if two:
            for d in range(3):
                own[WAY + d] = side if d == axis else 0.0
        nx, ny, nz = turned(rotation, o, own[WAY], own[WAY + 1], own[WAY + 2])
        for end in range(2 if two else 1):
            if two:
                s = high if end == 1 else low
                gap = above(own, axis, side, s)
            if gap - radius > reach:
                continue
            lever = 0.5 * (gap + radius)
            x, y, z = placed(position, rotation, i, 0.0, s, 0.0)
            name = 4 * axis + (2 if side > 0.0 else 0) + end if two else ALONE
            write_point(
                taken, name, gap - radius, -nx, -ny, -nz, x - lever * nx, y - lever * ny, z - lever * nz,
                feature, normal, depth, point,
            )  # fmt: skip
            taken += 1
        count[p] = taken - start[p]
    return taken


@inlined
def beyond(own, axis, s):
    """Return how far the point s of the segment is beyond the box's faces along an axis, with its sign."""
    x = own[MIDDLE + axis] + s * own[ALONG + axis]
    return x - min(max(x, -own[HALF + axis]), own[HALF + axis])


@inlined
def above(own, axis, side, s):
    """Return how high the point s of the segment is over a face of the box."""
    return side * (own[MIDDLE + axis] + s * own[ALONG + axis]) - own[HALF + axis]


@inlined
def slope(own, s):
    """Return half the derivative by s of the squared distance to the box."""
    return own[ALONG] * beyond(own, 0, s) + own[ALONG + 1] * beyond(own, 1, s) + own[ALONG + 2] * beyond(own, 2, s)


@inlined
def nearest_to_box(own, half):
    """Return the point s of the segment that is nearest to the box.

    The squared distance is convex and a parabola between the places where the segment passes the planes of the faces:
    these narrow the range until it holds one parabola, whose lowest point is the answer.
    """
    low, high = -half, half
    slope_low, slope_high = slope(own, low), slope(own, high)
    if slope_low >= 0.0 and slope_high > 0.0:
        return low
    if slope_high <= 0.0 and slope_low < 0.0:
        return high
    for axis in range(3):
        along = own[ALONG + axis]
        if along * along <= PARALLEL_EDGES:
            continue
        for side in range(2):
            edge = own[HALF + axis] if side == 1 else -own[HALF + axis]
            s = (edge - own[MIDDLE + axis]) / along
            if low < s < high:
                slope_s = slope(own, s)
                if slope_s < 0.0:
                    low, slope_low = s, slope_s
                elif slope_s > 0.0:
                    high, slope_high = s, slope_s
                else:
                    low, high, slope_low, slope_high = s, s, 0.0, 0.0
    if slope_high <= slope_low:
        return 0.5 * (low + high)
    return low - (high - low) * slope_low / (slope_high - slope_low)


@inlined
def over_face(own, half, axis):
    """Return (low, high) of the part of the segment that lies over a face, its sides moved out by BIAS."""
    low, high = -half, half
    for d in range(3):
        if d == axis:
            continue
        middle, along, edge = own[MIDDLE + d], own[ALONG + d], own[HALF + d] + BIAS
        if half * abs(along) <= BIAS:
            if abs(middle) > edge:
                return FAR, -FAR
            continue
        centre, width = -middle / along, abs(edge / along)
        low, high = max(low, centre - width), min(high, centre + width)
    return low, high


@inlined
def way_out(own, half):
    """Write the shortest way by which the segment leaves the box; return (gap, s of the point that leaves last)."""
    gap, last = -FAR, 0.0
    for d in range(3):
        side = 1.0 if own[MIDDLE + d] >= 0.0 else -1.0
        s = half if side * own[ALONG + d] < 0.0 else -half
        apart = above(own, d, side, s)
        if apart > gap + BIAS:
            gap, last = apart, s
            own[WAY], own[WAY + 1], own[WAY + 2] = 0.0, 0.0, 0.0
            own[WAY + d] = side
    for d in range(3):
        a, b = (d + 1) % 3, (d + 2) % 3
        squared = own[ALONG + a] * own[ALONG + a] + own[ALONG + b] * own[ALONG + b]
        if squared <= PARALLEL_EDGES:
            continue
        inverse = 1.0 / sqrt(squared)
        na, nb = -own[ALONG + b] * inverse, own[ALONG + a] * inverse
        if na * own[MIDDLE + a] + nb * own[MIDDLE + b] < 0.0:
            na, nb = -na, -nb
        apart = na * own[MIDDLE + a] + nb * own[MIDDLE + b] - own[HALF + a] * abs(na) - own[HALF + b] * abs(nb)
        if apart > gap + BIAS:
            gap = apart
            own[WAY + d], own[WAY + a], own[WAY + b] = 0.0, na, nb
            # the box's edge, along d, is at its corner towards n: where the segment passes it, seen along n
            ea, eb = own[HALF + a] * (1.0 if na >= 0.0 else -1.0), own[HALF + b] * (1.0 if nb >= 0.0 else -1.0)
            passed = ((ea - own[MIDDLE + a]) * own[ALONG + a] + (eb - own[MIDDLE + b]) * own[ALONG + b]) / squared
            last = min(max(passed, -half), half)
    return gap, last
