"""The points at which a cylinder, cone or ellipsoid lies on an edge of a mesh."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import ASKEW, BIAS, FLAT_COSINE
from carom.systems.kernels.cores import CORE, EXTENT, POSITION, SECOND, into, out_of
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.mesh_areas import MOST_CORNERS
from carom.systems.kernels.mesh_points import add_point
from carom.systems.kernels.mesh_tree import TRIANGLE
from carom.systems.kernels.outlines import outline
from carom.systems.kernels.spatial import cross


@woven
def points_on_edge(
    core, place, hulls, triangles, links, t, k, nx, ny, nz, gap, px, py, pz, reach, v, tag, plane, points, names, found
):  # fmt: skip
    """Add the points at which a round solid lies on an edge along n: both ends of a straight side or face, or one."""
    i, j = TRIANGLE * t + 3 * k, TRIANGLE * t + 3 * ((k + 1) % 3)
    qx, qy, qz = triangles[i], triangles[i + 1], triangles[i + 2]
    ex, ey, ez = triangles[j] - qx, triangles[j + 1] - qy, triangles[j + 2] - qz
    squared = ex * ex + ey * ey + ez * ez
    name = MOST_CORNERS + (16 * links[8 * t + 7] + (1 << k)) * MOST_CORNERS
    count, cosine = outline(core, SECOND, place, hulls, -nx, -ny, -nz, v, tag, plane)
    begin, end, least = 1.0, 0.0, 1e300
    if count == 2 and cosine >= FLAT_COSINE:
        dx, dy, dz = v[3] - v[0], v[4] - v[1], v[5] - v[2]
        cx, cy, cz = cross(dx, dy, dz, ex, ey, ez)
        if cx * cx + cy * cy + cz * cz <= ASKEW * ASKEW * squared * (dx * dx + dy * dy + dz * dz):
            begin = ((v[0] - qx) * ex + (v[1] - qy) * ey + (v[2] - qz) * ez) / squared
            end = ((v[3] - qx) * ex + (v[4] - qy) * ey + (v[5] - qz) * ez) / squared
            begin, end = min(begin, end), max(begin, end)
    elif count > 2 and cosine >= FLAT_COSINE:  # an end of the solid: the chord of its rim
        r = core[CORE + EXTENT]
        x, _, z = into(place, qx - place[POSITION], qy - place[POSITION + 1], qz - place[POSITION + 2])
        ux, _, uz = into(place, ex, ey, ez)
        uu, xu = ux * ux + uz * uz, x * ux + z * uz
        under = xu * xu - uu * (x * x + z * z - r * r)
        if under > 0.0 and uu > 0.0:
            begin, end = (-xu - sqrt(under)) / uu, (-xu + sqrt(under)) / uu
    begin, end = max(begin, 0.0), min(end, 1.0)
    if begin < end:
        for side in range(2):
            s = begin if side == 0 else end
            x, y, z = qx + s * ex, qy + s * ey, qz + s * ez
            if count > 2:  # along n to the plane of the end
                apart = (plane[3] - plane[0] * x - plane[1] * y - plane[2] * z) / (
                    plane[0] * nx + plane[1] * ny + plane[2] * nz
                )
            else:
                dx, dy, dz = v[3] - v[0], v[4] - v[1], v[5] - v[2]
                w = ((x - v[0]) * dx + (y - v[1]) * dy + (z - v[2]) * dz) / (dx * dx + dy * dy + dz * dz)
                apart = nx * (v[0] + w * dx - x) + ny * (v[1] + w * dy - y) + nz * (v[2] + w * dz - z)
            apart = max(apart, gap)  # not deeper than the pair, for what is beside the line or not quite flat
            if apart <= reach:
                least, half = min(least, apart), 0.5 * apart
                found = add_point(
                    points, names, found, nx, ny, nz, x + half * nx, y + half * ny, z + half * nz, apart, name + side
                )
    if least > gap + 2.0 * BIAS:
        x, y, z = out_of(place, px, py, pz)
        half = 0.5 * gap
        found = add_point(
            points, names, found, nx, ny, nz, place[POSITION] + x - half * nx, place[POSITION + 1] + y - half * ny,
            place[POSITION + 2] + z - half * nz, gap, name,
        )  # fmt: skip
    return found
