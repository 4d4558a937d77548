"""The points at which a body meets a mesh's triangles, made into few manifolds of up to four."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BETTER, SAME_NORMAL
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import cross, turn

MOST_MANIFOLDS = 4
MOST_MESH_POINTS = 4 * MOST_MANIFOLDS
WIDTH = 7  # numbers per point: normal from mesh to body, place midway between their surfaces, gap
TWIN = 1 << 50  # tells features apart that two manifolds share


@inlined
def add_point(points, names, count, nx, ny, nz, x, y, z, gap, name):
    """Write a point; return how many there are now."""
    k = WIDTH * count
    points[k], points[k + 1], points[k + 2] = nx, ny, nz
    points[k + 3], points[k + 4], points[k + 5], points[k + 6] = x, y, z, gap
    names[count] = name
    return count + 1


@inlined
def choose_points(points, names, count, least, kept):
    """Write into ``kept`` which of the points stand for all; return how many.

    The deepest point's manifold takes all whose normal is within SAME_NORMAL, then the deepest left begins the next.
    Of each the deepest stays, the farthest from it, and the widest to both sides; points nearer than ``least`` (m) are
    one. Names of points that are in a manifold become -1 - name.
    """
    if count == 1:
        kept[0], names[0] = 0, -1 - names[0]
        return 1
    taken = 0
    for _ in range(MOST_MANIFOLDS):
        deepest, gap = -1, 1e300
        for k in range(count):
            if names[k] >= 0 and points[WIDTH * k + 6] < gap - least * BETTER:
                deepest, gap = k, points[WIDTH * k + 6]
        if deepest < 0:
            return taken
        d = WIDTH * deepest
        nx, ny, nz, ox, oy, oz = points[d], points[d + 1], points[d + 2], points[d + 3], points[d + 4], points[d + 5]
        kept[taken] = deepest
        taken += 1
        farthest, most = -1, least * least
        for k in range(count):
            if names[k] < 0:
                continue
            i = WIDTH * k
            if nx * points[i] + ny * points[i + 1] + nz * points[i + 2] < SAME_NORMAL:
                continue
            names[k] = -1 - names[k]
            x, y, z = points[i + 3] - ox, points[i + 4] - oy, points[i + 5] - oz
            squared = x * x + y * y + z * z
            if squared > most:
                farthest, most = k, squared * (1.0 + BETTER)
        if farthest < 0:
            continue
        kept[taken] = farthest
        taken += 1
        f = WIDTH * farthest
        ux, uy, uz = points[f + 3] - ox, points[f + 4] - oy, points[f + 5] - oz
        sx, sy, sz = cross(nx, ny, nz, ux, uy, uz)
        limit = least * np.sqrt(ux * ux + uy * uy + uz * uz)
        left, right, leftmost, rightmost = -1, -1, limit, -limit
        for k in range(count):
            if names[k] >= 0:
                continue
            i = WIDTH * k
            if nx * points[i] + ny * points[i + 1] + nz * points[i + 2] < SAME_NORMAL:
                continue
            side = sx * (points[i + 3] - ox) + sy * (points[i + 4] - oy) + sz * (points[i + 5] - oz)
            if side > leftmost:
                left, leftmost = k, side * (1.0 + BETTER)
            if side < rightmost:
                right, rightmost = k, side * (1.0 + BETTER)
        for k in (left, right):
            if k >= 0:
                kept[taken] = k
                taken += 1
    return taken


@inlined
def write_chosen(
    points, names, kept, count, px, py, pz, qx, qy, qz, qw, taken, feature, normal, depth, point,
):  # fmt: skip
    """Write chosen points into the narrow phase's columns, from the mesh's frame, at p and turned by q, to the world.

    A feature is a point's name and the side of a cube its normal goes through, so that a body keeps its features when
    it slides from one triangle to the next; a lone point is the pair itself, however the body rolls.
    """
    for c in range(count):
        k = WIDTH * kept[c]
        x, y, z = points[k], points[k + 1], points[k + 2]
        wide, high, far = abs(x), 1.1 * abs(y), 1.23 * abs(z)  # so that slopes of 45 degrees are on no border
        name = (-1 - names[kept[c]]) * 6
        if wide >= high and wide >= far:
            name += 0 if x < 0.0 else 1
        elif high >= far:
            name += 2 if y < 0.0 else 3
        else:
            name += 4 if z < 0.0 else 5
        for other in range(c):
            if feature[taken + other] == name:
                name += TWIN
        feature[taken + c] = name if count > 1 else 0
        depth[taken + c] = -points[k + 6]
        x, y, z = turn(qx, qy, qz, qw, -x, -y, -z)
        normal[taken + c, 0], normal[taken + c, 1], normal[taken + c, 2] = x, y, z
        x, y, z = turn(qx, qy, qz, qw, points[k + 3], points[k + 4], points[k + 5])
        point[taken + c, 0], point[taken + c, 1], point[taken + c, 2] = px + x, py + y, pz + z
    return taken + count
