"""The corners of solids that are over a triangle of a mesh: of the face turned to it, and further ones."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import OVER_EDGE
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.mesh_areas import points_over_triangle
from carom.systems.kernels.mesh_points import add_point
from carom.systems.kernels.mesh_tree import TRIANGLE
from carom.systems.kernels.spatial import cross


@woven
def solid_over_triangle(
    v, end, loop_vertex, begin, stop, triangles, links, vertices, t, radius, reach, close, near,
    polygon, tag, room, points, names, found,
):  # fmt: skip
    """Do what `points_over_triangle` does, and add the other corners of the solid that are over the triangle.

    A body that rolls on comes down to those next.
    """
    found = points_over_triangle(
        v, loop_vertex, begin, stop, triangles, links, vertices, t, radius, reach, close, near,
        polygon, tag, room, points, names, found,
    )  # fmt: skip
    return corners_over_triangle(v, end, loop_vertex, begin, stop, triangles, t, reach, points, names, found)


@woven
def corners_over_triangle(v, end, loop_vertex, begin, stop, triangles, t, reach, points, names, found):
    """Add the corners of a solid that are over a triangle, but for those of one face; return how many points it has."""
    a = TRIANGLE * t
    nx, ny, nz = triangles[a + 9], triangles[a + 10], triangles[a + 11]
    for c in range(end):
        i = 3 * c
        qx, qy, qz = v[i] - triangles[a], v[i + 1] - triangles[a + 1], v[i + 2] - triangles[a + 2]
        gap, over = nx * qx + ny * qy + nz * qz, True
        if gap > reach:
            continue
        for k in range(begin, stop):
            over &= loop_vertex[k] != c
        for k in range(3 if over else 0):
            j, o = a + 3 * k, a + 3 * ((k + 1) % 3)
            x, y, z = cross(
                triangles[o] - triangles[j], triangles[o + 1] - triangles[j + 1], triangles[o + 2] - triangles[j + 2],
                nx, ny, nz,
            )  # fmt: skip
            out = x * (v[i] - triangles[j]) + y * (v[i + 1] - triangles[j + 1]) + z * (v[i + 2] - triangles[j + 2])
            over &= out * triangles[a + 12 + k] <= OVER_EDGE
        if over:
            half = 0.5 * gap
            found = add_point(
                points, names, found, nx, ny, nz, v[i] - half * nx, v[i + 1] - half * ny, v[i + 2] - half * nz, gap, c
            )
    return found
