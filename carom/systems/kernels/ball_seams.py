"""Seams under balls: where boxes lie side by side, a ball is borne by the one that it is over.

The edge of the other would bear it as well for as long as it is no more than a hair away, and push it along.
"""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import OVER_EDGE, TOUCH
from carom.systems.kernels.balls import BOX, pose_of_other
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.spatial import turn


@kernel("beside", makes_arrays=True)
def link_boxes(count, kind, ball, bodies, beside):
    """Write a ring of the contacts that each ball has with boxes: ``beside`` each is the next one, or itself."""
    last = np.full(bodies, -1)
    for c in range(count):
        beside[c] = c
        if kind[c] == BOX:
            before = last[ball[c]]
            if before >= 0:
                beside[c], beside[before] = beside[before], c
            last[ball[c]] = c


@inlined
def is_borne_beside(
    c, beside, center, rotation, ball, other, sign, radius, extent, other_position, other_rotation, normal, depth
):
    """Tell whether contact c of a ball is at an edge of its box that lies on another box, of which a face bears it."""
    x, y, z = center[ball[c], 0], center[ball[c], 1], center[ball[c], 2]
    across = 0
    for beyond in beyond_box(c, x, y, z, center, rotation, other, extent, other_position, other_rotation):
        across += beyond > 0.0
    if across < 2:
        return False
    to = sign[c] * (radius[c] - depth[c])
    px, py, pz = x + to * normal[c, 0], y + to * normal[c, 1], z + to * normal[c, 2]
    k = beside[c]
    while k != c:
        across, height = 0, 0.0
        for beyond in beyond_box(k, x, y, z, center, rotation, other, extent, other_position, other_rotation):
            across += beyond > 0.0
            height = max(height, beyond)
        if across < 2 and height - radius[k] <= TOUCH:
            lies_on = True
            for beyond in beyond_box(k, px, py, pz, center, rotation, other, extent, other_position, other_rotation):
                lies_on &= beyond <= OVER_EDGE
            if lies_on:
                return True
        k = beside[k]
    return False


@inlined
def beyond_box(c, x, y, z, center, rotation, other, extent, other_position, other_rotation):
    """Return how far a place is beyond the faces of the box that contact c is with, along each of its axes."""
    ox, oy, oz, qx, qy, qz, qw = pose_of_other(c, other[c], center, rotation, other_position, other_rotation)
    x, y, z = turn(-qx, -qy, -qz, qw, x - ox, y - oy, z - oz)
    return abs(x) - extent[c, 0], abs(y) - extent[c, 1], abs(z) - extent[c, 2]
