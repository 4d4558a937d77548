"""Rolling on: where what is round touches a face as its body turns."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import AS_LOW, ON_SIDE, ROLLED_ON, ROLLING_POINT
from carom.systems.kernels.cores import CONE_SHAPE, CYLINDER_SHAPE, ELLIPSOID, ELLIPSOID_SHAPE, farthest_of_round
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import product, spun, turn


@inlined
def roll_on(
    first, end, i, body, outward, time, shape, size, position, rotation, center, angular, normal, offset, offset_other
):  # fmt: skip
    """Move contacts of round collider i and a face to where they are ``time`` (s) on, as its body turns.

    Other points of a rim or an ellipsoid touch then: held where they touched at first, drums that wobble would sink by
    what their lowest point has turned on by. Those are moved that are lowest at their end, with the ``offset`` from the
    body and that of the other. The normal leads out of the collider where ``outward`` is 1, else -1. Not moved is what
    comes to lie flat, and touches elsewhere, and a rim that leans by less than AS_LOW, all of which is as low.
    """
    dx, dy, dz, dw = spun(0.0, 0.0, 0.0, 1.0, angular[body, 0], angular[body, 1], angular[body, 2], time)
    qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
    px, py, pz, pw = product(dx, dy, dz, dw, qx, qy, qz, qw)
    sx, sy, sz = position[i, 0] - center[body, 0], position[i, 1] - center[body, 1], position[i, 2] - center[body, 2]
    tx, ty, tz = turn(dx, dy, dz, dw, sx, sy, sz)
    ax, ay, az = turn(qx, qy, qz, qw, 0.0, 1.0, 0.0)
    for c in range(first, end):
        nx, ny, nz = outward * normal[c, 0], outward * normal[c, 1], outward * normal[c, 2]
        upright = nx * ax + ny * ay + nz * az
        if shape[i] != ELLIPSOID_SHAPE and (1.0 - upright * upright) * size[i, 0] ** 2 <= AS_LOW * AS_LOW:
            continue
        if shape[i] == CYLINDER_SHAPE and upright * upright <= ON_SIDE * ON_SIDE:  # `sink_points` does
            continue
        _, upper, _ = turn(-qx, -qy, -qz, qw, offset[c, 0] - sx, offset[c, 1] - sy, offset[c, 2] - sz)
        x, y, z = lowest(i, upper, qx, qy, qz, qw, nx, ny, nz, shape, size)
        x, y, z = x + sx, y + sy, z + sz
        off = (offset[c, 0] - x) ** 2 + (offset[c, 1] - y) ** 2 + (offset[c, 2] - z) ** 2
        ux, uy, uz = lowest(i, upper, px, py, pz, pw, nx, ny, nz, shape, size)
        x, y, z = ux + tx - x, uy + ty - y, uz + tz - z
        along = nx * x + ny * y + nz * z
        x, y, z = x - along * nx, y - along * ny, z - along * nz
        if off > (ROLLING_POINT * size[i, 0]) ** 2 or x * x + y * y + z * z > (ROLLED_ON * size[i, 0]) ** 2:
            continue
        for k, way in enumerate((x, y, z)):
            offset[c, k] += way
            offset_other[c, k] += way


@inlined
def lowest(i, upper, qx, qy, qz, qw, nx, ny, nz, shape, size):
    """Return the point of round collider i, turned to q, that is farthest along n of its ``upper`` or its other end."""
    a, b = size[i, 0], 0.5 * size[i, 1]
    x, y, z = turn(-qx, -qy, -qz, qw, nx, ny, nz)
    if shape[i] == ELLIPSOID_SHAPE:
        x, y, z = farthest_of_round(ELLIPSOID, a, size[i, 1], size[i, 2], x, y, z)
    elif shape[i] == CONE_SHAPE and upper > 0.0:
        x, y, z = 0.0, b, 0.0
    else:
        across = sqrt(x * x + z * z)
        scale = a / across if across > 0.0 else 0.0
        x, y, z = scale * x, b if upper > 0.0 else -b, scale * z
    return turn(qx, qy, qz, qw, x, y, z)
