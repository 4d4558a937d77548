"""A segment in the frame of a box: where it is nearest, what of it lies over a face, and its way out."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, PARALLEL_EDGES
from carom.systems.kernels.kernel import inlined

FAR = 1e300
MIDDLE, ALONG, HALF, WAY = 0, 3, 6, 9  # of the scratch: the segment's middle and direction, half edges, the way out


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
def within_faces(own, d, low, high):
    """Return (low, high) of the part of the segment that lies between two faces of the box, moved out by BIAS."""
    middle, along, edge = own[MIDDLE + d], own[ALONG + d], own[HALF + d] + BIAS
    if (high - low) * abs(along) <= 2.0 * BIAS:
        return (low, high) if abs(middle) <= edge else (FAR, -FAR)
    centre, width = -middle / along, abs(edge / along)
    return max(low, centre - width), min(high, centre + width)


@inlined
def longest(own, of):
    """Return the axis along which a vector of the scratch is longest."""
    axis = 0
    for d in range(1, 3):
        if abs(own[of + d]) > abs(own[of + axis]):
            axis = d
    return axis


@inlined
def gap_beyond(own, s):
    """Return how far the point s of the segment is from the box."""
    x, y, z = beyond(own, 0, s), beyond(own, 1, s), beyond(own, 2, s)
    return sqrt(x * x + y * y + z * z)


@inlined
def gap_from_edge(own, edge, s):
    """Return how far the point s of the segment, which is beside an edge along an axis, is from the box."""
    y, z = beyond(own, (edge + 1) % 3, s), beyond(own, (edge + 2) % 3, s)
    return sqrt(y * y + z * z)


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
