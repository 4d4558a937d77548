"""The points at which a body meets a mesh's triangles, made into few manifolds of up to eight."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BETTER, SAME_NORMAL
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.low_points import span_low
from carom.systems.kernels.reduction import MOST_POINTS, swap
from carom.systems.kernels.spatial import turn

MOST_MANIFOLDS = 4
MOST_MESH_POINTS = MOST_POINTS * MOST_MANIFOLDS
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
def as_deep_as(points, begin, end, nx, ny, nz, gap):
    """Let points be along a normal n, the deepest of them with this gap."""
    least = 1e300
    for k in range(begin, end):
        least = min(least, points[WIDTH * k + 6])
    for k in range(WIDTH * begin, WIDTH * end, WIDTH):
        points[k], points[k + 1], points[k + 2] = nx, ny, nz
        points[k + 6] += gap - least


@inlined
def choose_points(points, names, count, least, beyond, kept, place, gaps, which):
    """Write into ``kept`` which of the points stand for all; return how many.

    The deepest point's manifold takes all whose normal is within SAME_NORMAL, then the deepest left begins the next.
    Of each those stay that `span_low` chooses, more than four that do not touch only up to a gap ``beyond``; points
    nearer than ``least`` (m) are one. Names of points that are in a manifold become -1 - name. ``place``, ``gaps`` and
    ``which`` are for the points of one manifold.
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
            break
        d, alike = WIDTH * deepest, 0
        nx, ny, nz = points[d], points[d + 1], points[d + 2]
        for k in range(count):
            i = WIDTH * k
            if names[k] >= 0 and nx * points[i] + ny * points[i + 1] + nz * points[i + 2] >= SAME_NORMAL:
                names[k] = -1 - names[k]
                which[alike], gaps[alike] = k, points[i + 6]
                for x in range(3):
                    place[3 * alike + x] = points[i + 3 + x]
                if k == deepest:
                    swap(0, alike, place, gaps, which)
                alike += 1
        found = span_low(place, gaps, which, alike, nx, ny, nz, least, max(least, beyond))
        for k in range(found):
            kept[taken] = which[k]
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
