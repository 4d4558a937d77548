"""From what of a triangle of a mesh a cylinder, cone or ellipsoid parts most: its face, an edge, or a corner."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BESIDE_FACE, BIAS, BORDER, OVER_EDGE
from carom.systems.kernels.cores import POSITION, SECOND, farthest, into, out_of
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.mesh_surface import CORNER, falls_away, is_tip
from carom.systems.kernels.mesh_tree import TRIANGLE
from carom.systems.kernels.rounds import parted_from_edge, parted_from_point
from carom.systems.kernels.spatial import cross

NOTHING, ON_FACE, ON_EDGE, ON_CORNER = 0, 1, 2, 3


@inlined
def beyond_edge(triangles, links, vertices, t, k):
    """Return (whether there is one, unit normal of the triangle beyond an edge)."""
    o = 3 * links[8 * t + 3 + k]
    if o < 0:
        return False, 0.0, 0.0, 0.0
    i, j = TRIANGLE * t + 3 * k, TRIANGLE * t + 3 * ((k + 1) % 3)
    x, y, z = cross(
        triangles[i] - triangles[j], triangles[i + 1] - triangles[j + 1], triangles[i + 2] - triangles[j + 2],
        vertices[o] - triangles[j], vertices[o + 1] - triangles[j + 1], vertices[o + 2] - triangles[j + 2],
    )  # fmt: skip
    scale = 1.0 / sqrt(x * x + y * y + z * z)
    return True, x * scale, y * scale, z * scale


@woven
def parted_from_triangle(
    core, place, hulls_vertices, triangles, links, vertices, fan_start, fan, t, far, size
):  # fmt: skip
    """Return (kind, gap, unit normal from the mesh, edge, point of the solid) where a round solid meets a triangle.

    It parts most from its face, from one of the active edges, between the normals of the two triangles there, or from
    one of their corners, where the mesh falls away about it; so there are no ghosts within flat and hollow areas.
    NOTHING: farther than ``far``, or what is beyond a convex edge parts it by less than BORDER of the depth here.
    ``size``: no point of the solid is farther from its middle (m).
    """
    a = TRIANGLE * t
    nx, ny, nz = triangles[a + 9], triangles[a + 10], triangles[a + 11]
    lx, ly, lz = into(place, nx, ny, nz)
    px, py, pz = farthest(core, SECOND, hulls_vertices, -lx, -ly, -lz)
    level = nx * (triangles[a] - place[POSITION]) + ny * (triangles[a + 1] - place[POSITION + 1])
    level += nz * (triangles[a + 2] - place[POSITION + 2])
    gap = lx * px + ly * py + lz * pz - level
    kind, edge, most, within = ON_FACE, -1, gap, (size + far) * (size + far)
    if gap > far:
        return NOTHING, gap, nx, ny, nz, edge, px, py, pz
    active = links[8 * t + 6]
    for k in range(3):
        i, j = a + 3 * k, a + 3 * ((k + 1) % 3)
        qx, qy, qz = into(
            place, triangles[i] - place[POSITION], triangles[i + 1] - place[POSITION + 1],
            triangles[i + 2] - place[POSITION + 2],
        )  # fmt: skip
        for way in range(3 if active & (1 << k | 1 << (k + 2) % 3) and qx * qx + qy * qy + qz * qz <= within else 0):
            apart, x, y, z = parted_from_point(core, way, qx, qy, qz)
            if apart <= min(gap, most):
                continue
            fx, fy, fz = out_of(place, -x, -y, -z)
            most = max(most, apart - out_beyond(triangles, a, i, fx, fy, fz))
            if not gap < apart <= far:
                continue
            if apart > 0.0:
                outer = falls_away(links, vertices, fan_start, fan, t, CORNER + k, fx, fy, fz)
            else:
                outer = is_tip(links, vertices, fan_start, fan, t, k, fx, fy, fz)
            if outer:
                kind, gap, nx, ny, nz = ON_CORNER, apart, fx, fy, fz
                px, py, pz = qx - apart * x, qy - apart * y, qz - apart * z
        if not active & (1 << k):
            continue
        scale = triangles[a + 12 + k]
        ux, uy, uz = into(
            place, scale * (triangles[j] - triangles[i]), scale * (triangles[j + 1] - triangles[i + 1]),
            scale * (triangles[j + 2] - triangles[i + 2]),
        )  # fmt: skip
        along = min(max(-(qx * ux + qy * uy + qz * uz), 0.0), 1.0 / scale)
        dx, dy, dz = qx + along * ux, qy + along * uy, qz + along * uz
        if dx * dx + dy * dy + dz * dz > within:
            continue
        known, bx, by, bz = beyond_edge(triangles, links, vertices, t, k)
        bx, by, bz = into(place, bx, by, bz) if known else cross(ux, uy, uz, lx, ly, lz)
        x, y, z, apart, rx, ry, rz = parted_from_edge(
            core, hulls_vertices, lx, ly, lz, bx, by, bz, qx, qy, qz, ux, uy, uz
        )
        if (x - lx) * (x - lx) + (y - ly) * (y - ly) + (z - lz) * (z - lz) <= 4.0 * BESIDE_FACE * BESIDE_FACE:
            continue
        most = max(most, apart)
        if (x - bx) * (x - bx) + (y - by) * (y - by) + (z - bz) * (z - bz) <= 4.0 * BESIDE_FACE * BESIDE_FACE:
            continue
        along = (rx - qx) * ux + (ry - qy) * uy + (rz - qz) * uz
        if gap < apart <= far and -OVER_EDGE <= along <= 1.0 / scale + OVER_EDGE:
            kind, gap, edge, px, py, pz = ON_EDGE, apart, k, rx, ry, rz
            nx, ny, nz = out_of(place, x, y, z)
    if gap < 0.0 and BORDER * (gap + BIAS) < most:
        kind = NOTHING
    return kind, gap, nx, ny, nz, edge, px, py, pz


@inlined
def out_beyond(triangles, a, i, x, y, z):
    """Return how far a triangle reaches along a direction from its corner at i."""
    most = 0.0
    for j in range(a, a + 9, 3):
        along = x * (triangles[j] - triangles[i]) + y * (triangles[j + 1] - triangles[i + 1])
        most = max(most, along + z * (triangles[j + 2] - triangles[i + 2]))
    return most
