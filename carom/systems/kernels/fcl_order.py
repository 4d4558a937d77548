"""Who goes first in a pair that FCL measures, and where the second is seen from there."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.hulls_narrow import comes_first
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.narrow import PLANE_SHAPE
from carom.systems.kernels.spatial import product, turn
from carom.systems.shapes.orientation import Z_TO_Y

TURN_X, TURN_Y, TURN_Z, TURN_W = Z_TO_Y


@kernel("first", "second", "turns", "shifts")
def arrange_for_fcl(
    which, pairs, reaches, shape, size, geometry, position, rotation, along_z, first, second, turns, shifts
):
    """Write who is measured first, and the turn (wxyz) and place of the second in the frame in which FCL has the first.

    The order follows from shapes, sizes and poses alone, so that swapping the sides of a pair flips its normals and
    changes no bit else; a half space goes second, and is moved out by the reach. ``along_z[k]`` tells by rows which
    shapes FCL lays along z.
    """
    for k in range(len(which)):
        p = which[k]
        a, b = pairs[p, 0], pairs[p, 1]
        if not goes_first(a, b, shape, size, geometry, position, rotation):
            a, b = b, a
        first[k], second[k] = a, b
        ax, ay, az, aw = turn_for_fcl(rotation, a, along_z[shape[a]])
        bx, by, bz, bw = turn_for_fcl(rotation, b, along_z[shape[b]])
        x, y, z, w = product(-ax, -ay, -az, aw, bx, by, bz, bw)
        turns[k, 0], turns[k, 1], turns[k, 2], turns[k, 3] = w, x, y, z
        x, y, z = turn(
            -ax, -ay, -az, aw,
            position[b, 0] - position[a, 0], position[b, 1] - position[a, 1], position[b, 2] - position[a, 2],
        )  # fmt: skip
        if shape[b] == PLANE_SHAPE:
            mx, my, mz = turn(turns[k, 1], turns[k, 2], turns[k, 3], turns[k, 0], size[b, 0], size[b, 1], size[b, 2])
            x, y, z = x + reaches[p] * mx, y + reaches[p] * my, z + reaches[p] * mz
        shifts[k, 0], shifts[k, 1], shifts[k, 2] = x, y, z


@inlined
def turn_for_fcl(rotation, row, along_z):
    """Return the rotation of FCL's geometry of a collider."""
    x, y, z, w = rotation[row, 0], rotation[row, 1], rotation[row, 2], rotation[row, 3]
    if along_z:
        return product(x, y, z, w, TURN_X, TURN_Y, TURN_Z, TURN_W)
    return x, y, z, w


@inlined
def goes_first(a, b, shape, size, geometry, position, rotation):
    """Tell whether collider a is measured before b: half spaces last, then by shape, size and pose."""
    if shape[a] != shape[b]:
        if shape[a] == PLANE_SHAPE or shape[b] == PLANE_SHAPE:
            return shape[b] == PLANE_SHAPE
        return shape[a] < shape[b]
    for d in range(size.shape[1]):
        if size[a, d] != size[b, d]:
            return size[a, d] > size[b, d]
    if geometry[a] != geometry[b]:
        return geometry[a] < geometry[b]
    return comes_first(0, a, 0, b, position, rotation)
