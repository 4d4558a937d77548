"""The points at which a cylinder, cone or ellipsoid lies on an edge of a mesh."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, FLAT_COSINE
from carom.systems.kernels.cores import CORE, EXTENT, POSITION, SECOND, into, out_of
from carom.systems.kernels.footprints import radius_of
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.mesh_areas import MOST_CORNERS
from carom.systems.kernels.mesh_points import add_point
from carom.systems.kernels.mesh_tree import TRIANGLE
from carom.systems.kernels.outlines import outline
from carom.systems.kernels.overlays import beside_line


@woven
def points_on_edge(
    core, place, hulls, triangles, links, t, k, nx, ny, nz, gap, px, py, pz, reach, v, tag, plane,
    edge, ends, gaps, sides, points, names, found,
):  # fmt: skip
    """Add the points at which a round solid lies on an edge along n: both ends of a straight side or face, or one.

    ``edge`` and ``ends`` have room for two points, ``gaps`` and ``sides`` for a number of each.
    """
    i, j = TRIANGLE * t + 3 * k, TRIANGLE * t + 3 * ((k + 1) % 3)
    for d in range(3):
        edge[d], edge[3 + d] = triangles[i + d], triangles[j + d]
    name = MOST_CORNERS + (16 * links[8 * t + 7] + (1 << k)) * MOST_CORNERS
    count, cosine = outline(core, SECOND, place, hulls, -nx, -ny, -nz, v, tag, plane)
    number, least = 0, 1e300
    if count == 2 and cosine >= FLAT_COSINE:
        round_one = radius_of(core, CORE, count)
        number = beside_line(v, edge, round_one, 0.0, gap, -nx, -ny, -nz, reach, ends, gaps, sides)
    elif count > 2 and cosine >= FLAT_COSINE:
        number = on_chord(core, place, edge, nx, ny, nz, gap, reach, plane, ends, gaps, sides)
    for side in range(number):
        least, half = min(least, gaps[side]), 0.5 * gaps[side]
        found = add_point(
            points, names, found, nx, ny, nz, ends[3 * side] - half * nx, ends[3 * side + 1] - half * ny,
            ends[3 * side + 2] - half * nz, gaps[side], name + sides[side],
        )  # fmt: skip
    if least > gap + 2.0 * BIAS:
        x, y, z = out_of(place, px, py, pz)
        half = 0.5 * gap
        found = add_point(
            points, names, found, nx, ny, nz, place[POSITION] + x - half * nx, place[POSITION + 1] + y - half * ny,
            place[POSITION + 2] + z - half * nz, gap, name,
        )  # fmt: skip
    return found


@woven
def on_chord(core, place, edge, nx, ny, nz, gap, reach, plane, ends, gaps, sides):
    """Write the ends of what an edge has of the end of a solid, the chord of its rim; return how many."""
    r = core[CORE + EXTENT]
    ex, ey, ez = edge[3] - edge[0], edge[4] - edge[1], edge[5] - edge[2]
    x, _, z = into(place, edge[0] - place[POSITION], edge[1] - place[POSITION + 1], edge[2] - place[POSITION + 2])
    ux, _, uz = into(place, ex, ey, ez)
    uu, xu = ux * ux + uz * uz, x * ux + z * uz
    under = xu * xu - uu * (x * x + z * z - r * r)
    if not (under > 0.0 and uu > 0.0):
        return 0
    begin, end = max((-xu - sqrt(under)) / uu, 0.0), min((-xu + sqrt(under)) / uu, 1.0)
    found = 0
    for side in range(2 if begin < end else 0):
        s = begin if side == 0 else end
        x, y, z = edge[0] + s * ex, edge[1] + s * ey, edge[2] + s * ez
        # Along n to the plane of the end; not deeper than the pair, for what is not quite flat.
        apart = (plane[3] - plane[0] * x - plane[1] * y - plane[2] * z) / (
            plane[0] * nx + plane[1] * ny + plane[2] * nz
        )
        apart = max(apart, gap)
        if apart <= reach:
            gaps[found], sides[found] = apart, 1 + side
            ends[3 * found], ends[3 * found + 1], ends[3 * found + 2] = x + apart * nx, y + apart * ny, z + apart * nz
            found += 1
    return found
