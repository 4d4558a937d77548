"""The fifteen axes that may part two boxes: the normals of their faces and the common normals of their edges."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, PARALLEL_EDGES
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.spatial import product, turn

# What one box sees of another, in its own frame, as numbers in a row: the other's axes as columns of a matrix, the
# other's centre, its own half edges and the other's. The view of the other box follows.
TURN, PLACE, OWN, OTHER, VIEW = 0, 9, 12, 15, 18
FAR = 1e300


@inlined
def after(axis):
    """Return the axis after x, y or z."""
    return axis + 1 if axis < 2 else 0


@woven
def look(view, position, rotation, size, i, o):
    """Write how box i sees box o and how o sees i."""
    x, y, z, w = -rotation[i, 0], -rotation[i, 1], -rotation[i, 2], rotation[i, 3]
    dx, dy, dz = position[o, 0] - position[i, 0], position[o, 1] - position[i, 1], position[o, 2] - position[i, 2]
    px, py, pz = turn(x, y, z, w, dx, dy, dz)
    x, y, z, w = product(x, y, z, w, rotation[o, 0], rotation[o, 1], rotation[o, 2], rotation[o, 3])
    xx, yy, zz = 2.0 * x * x, 2.0 * y * y, 2.0 * z * z
    xy, xz, yz, wx, wy, wz = 2.0 * x * y, 2.0 * x * z, 2.0 * y * z, 2.0 * w * x, 2.0 * w * y, 2.0 * w * z
    view[TURN], view[TURN + 1], view[TURN + 2] = 1.0 - yy - zz, xy - wz, xz + wy
    view[TURN + 3], view[TURN + 4], view[TURN + 5] = xy + wz, 1.0 - xx - zz, yz - wx
    view[TURN + 6], view[TURN + 7], view[TURN + 8] = xz - wy, yz + wx, 1.0 - xx - yy
    view[PLACE], view[PLACE + 1], view[PLACE + 2] = px, py, pz
    for c in range(3):
        tx, ty, tz = view[TURN + c], view[TURN + 3 + c], view[TURN + 6 + c]
        row = VIEW + TURN + 3 * c
        view[row], view[row + 1], view[row + 2] = tx, ty, tz
        view[VIEW + PLACE + c] = -(tx * px + ty * py + tz * pz)
        view[OWN + c] = view[VIEW + OTHER + c] = 0.5 * size[i, c]
        view[OTHER + c] = view[VIEW + OWN + c] = 0.5 * size[o, c]


@woven
def widest_face(view, at):
    """Return (axis, side, gap) of the own face that parts the boxes most; the first of those as good to BIAS."""
    axis, gap = 0, -FAR
    for r in range(3):
        row = at + TURN + 3 * r
        extent = (
            abs(view[row]) * view[at + OTHER]
            + abs(view[row + 1]) * view[at + OTHER + 1]
            + abs(view[row + 2]) * view[at + OTHER + 2]
        )
        apart = abs(view[at + PLACE + r]) - view[at + OWN + r] - extent
        axis, gap = (r, apart) if apart > gap + BIAS else (axis, gap)
    return axis, (1.0 if view[at + PLACE + axis] >= 0.0 else -1.0), gap


@woven
def widest_edges(view, gap):
    """Return (3 i + j, gap) of the edges, along axis i of the first and j of the second, whose normal parts them most.

    -1 and the given gap where none parts them more than that.
    """
    edges = -1
    for i in range(3):
        i1, i2 = after(i), after(after(i))
        for j in range(3):
            j1, j2 = after(j), after(after(j))
            low, high = view[TURN + 3 * i1 + j], view[TURN + 3 * i2 + j]
            apart = (
                abs(view[PLACE + i2] * low - view[PLACE + i1] * high)
                - view[OWN + i1] * abs(high)
                - view[OWN + i2] * abs(low)
                - view[OTHER + j1] * abs(view[TURN + 3 * i + j2])
                - view[OTHER + j2] * abs(view[TURN + 3 * i + j1])
            )  # times the sine of the edges' angle, which can only bring it nearer to zero
            squared = low * low + high * high
            if (apart <= min(gap, 0.0)) | (squared <= PARALLEL_EDGES):
                continue
            apart /= sqrt(squared)
            if apart > gap:
                edges, gap = 3 * i + j, apart
    return edges, gap


@inlined
def edge_normal(view, edges):
    """Return the common normal of two edges in the first frame, towards the second box."""
    i, j = edges // 3, edges % 3
    x, y, z = 0.0, 0.0, 0.0
    low, high = view[TURN + 3 * after(i) + j], view[TURN + 3 * after(after(i)) + j]
    inverse = 1.0 / sqrt(low * low + high * high)
    low, high = low * inverse, high * inverse
    if i == 0:
        x, y, z = 0.0, -high, low
    elif i == 1:
        x, y, z = low, 0.0, -high
    else:
        x, y, z = -high, low, 0.0
    if x * view[PLACE] + y * view[PLACE + 1] + z * view[PLACE + 2] < 0.0:
        return -x, -y, -z
    return x, y, z


@inlined
def along_axis(view, at, axis, x, y, z):
    """Return the component along an axis of the box whose view is ``at``, of a direction in the first frame."""
    if at == 0:
        return x if axis == 0 else (y if axis == 1 else z)
    return x * view[TURN + axis] + y * view[TURN + 3 + axis] + z * view[TURN + 6 + axis]
