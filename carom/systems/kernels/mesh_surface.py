"""What a mesh is like around a triangle: where it is nearest to a point, and which way its edges and corners face."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import LEANING
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.mesh_tree import TRIANGLE

EDGE, CORNER, FACE = 0, 3, 6  # parts of a triangle: edges 0 to 2, corners 3 to 5, the face


@inlined
def nearest_on_triangle(triangles, t, x, y, z):
    """Return the point of a triangle nearest to another, and the part it lies on (Ericson 5.1.5)."""
    k = TRIANGLE * t
    ax, ay, az = triangles[k], triangles[k + 1], triangles[k + 2]
    ux, uy, uz = triangles[k + 3] - ax, triangles[k + 4] - ay, triangles[k + 5] - az
    vx, vy, vz = triangles[k + 6] - ax, triangles[k + 7] - ay, triangles[k + 8] - az
    x, y, z = x - ax, y - ay, z - az
    d1, d2 = ux * x + uy * y + uz * z, vx * x + vy * y + vz * z
    if d1 <= 0.0 and d2 <= 0.0:
        return ax, ay, az, CORNER
    uu, uv, vv = ux * ux + uy * uy + uz * uz, ux * vx + uy * vy + uz * vz, vx * vx + vy * vy + vz * vz
    d3, d4 = d1 - uu, d2 - uv
    if d3 >= 0.0 and d4 <= d3:
        return ax + ux, ay + uy, az + uz, CORNER + 1
    vc = d1 * d4 - d3 * d2
    if vc <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        s = d1 / uu
        return ax + s * ux, ay + s * uy, az + s * uz, EDGE
    d5, d6 = d1 - uv, d2 - vv
    if d6 >= 0.0 and d5 <= d6:
        return ax + vx, ay + vy, az + vz, CORNER + 2
    vb = d5 * d2 - d1 * d6
    if vb <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        s = d2 / vv
        return ax + s * vx, ay + s * vy, az + s * vz, EDGE + 2
    va = d3 * d6 - d5 * d4
    if va <= 0.0 and d4 >= d3 and d5 >= d6:
        s = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        return ax + ux + s * (vx - ux), ay + uy + s * (vy - uy), az + uz + s * (vz - uz), EDGE + 1
    s = 1.0 / (va + vb + vc)
    v, w = vb * s, vc * s
    return ax + v * ux + w * vx, ay + v * uy + w * vy, az + v * uz + w * vz, FACE


@inlined
def on_rim(links, t, part):
    """Tell whether a triangle's edge or corner lies on the rim of its mesh."""
    if part < CORNER:
        return links[8 * t + 3 + part] < 0
    if part < FACE:
        return links[8 * t + part] < 0 or links[8 * t + 3 + (part - 1) % 3] < 0  # edges after and before it
    return False


@inlined
def falls_away(links, vertices, fan_start, fan, t, part, x, y, z):
    """Tell whether a mesh falls away from a direction about a triangle's edge or corner, to which it is square.

    Only then is the part outermost there, so that another body may touch it with that normal: an edge within a flat or
    hollow area never is. LEANING is let off.
    """
    if part >= FACE:
        return True
    if part < CORNER:
        at = 3 * links[8 * t + part]
        beyond = links[8 * t + 3 + part]
        return beyond < 0 or not leads(vertices, at, 3 * beyond, x, y, z)
    corner = links[8 * t + part - CORNER]
    for k in range(fan_start[corner], fan_start[corner + 1]):
        if leads(vertices, 3 * corner, 3 * fan[k], x, y, z):
            return False
    return True


@inlined
def leads(vertices, i, j, x, y, z):
    """Tell whether the way from one vertex to another goes along a direction."""
    ux, uy, uz = vertices[j] - vertices[i], vertices[j + 1] - vertices[i + 1], vertices[j + 2] - vertices[i + 2]
    along = x * ux + y * uy + z * uz
    if along <= 0.0:
        return False
    return along * along > LEANING * LEANING * (ux * ux + uy * uy + uz * uz) * (x * x + y * y + z * z)
