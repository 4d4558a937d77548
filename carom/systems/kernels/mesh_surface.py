"""What a mesh is like around a triangle: where it is nearest to a point, and which way its edges and corners face."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import LEANING, LEAST_PART
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.mesh_tree import TRIANGLE
from carom.systems.kernels.simplex import weights_on_triangle

EDGE, CORNER, FACE = 0, 3, 6  # parts of a triangle: edges 0 to 2, corners 3 to 5, the face


@inlined
def nearest_on_triangle(triangles, t, x, y, z):
    """Return the point of a triangle nearest to another, and the part it lies on."""
    k = TRIANGLE * t
    ax, ay, az = triangles[k], triangles[k + 1], triangles[k + 2]
    bx, by, bz = triangles[k + 3], triangles[k + 4], triangles[k + 5]
    cx, cy, cz = triangles[k + 6], triangles[k + 7], triangles[k + 8]
    a, b, c = weights_on_triangle(ax - x, ay - y, az - z, bx - x, by - y, bz - z, cx - x, cy - y, cz - z)
    if b == 0.0 and c == 0.0:
        return ax, ay, az, CORNER
    if a == 0.0 and c == 0.0:
        return bx, by, bz, CORNER + 1
    if a == 0.0 and b == 0.0:
        return cx, cy, cz, CORNER + 2
    part = EDGE if c == 0.0 else EDGE + 1 if a == 0.0 else EDGE + 2 if b == 0.0 else FACE
    return a * ax + b * bx + c * cx, a * ay + b * by + c * cy, a * az + b * bz + c * cz, part


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
        if leads(vertices, 3 * corner, 3 * (fan[k] >> 1), x, y, z):
            return False
    return True


@inlined
def is_tip(links, vertices, fan_start, fan, t, corner, x, y, z):
    """Tell whether a mesh falls away from a direction about a triangle's corner, and the direction leads out of it.

    Seen from inside, a hollow falls away too. The edge that falls least is on the border of the cone that all of them
    lie in: convex at a tip, hollow in a hollow. LEANING is let off.
    """
    i = links[8 * t + corner]
    most, most_convex = -2.0, -2.0
    for k in range(fan_start[i], fan_start[i + 1]):
        at, to = 3 * i, 3 * (fan[k] >> 1)
        ux, uy = vertices[to] - vertices[at], vertices[to + 1] - vertices[at + 1]
        uz = vertices[to + 2] - vertices[at + 2]
        cosine = (x * ux + y * uy + z * uz) / sqrt(ux * ux + uy * uy + uz * uz)
        if cosine > LEANING:
            return False
        most = max(most, cosine)
        if fan[k] & 1:
            most_convex = max(most_convex, cosine)
    return most_convex >= most - LEANING


@inlined
def leads(vertices, i, j, x, y, z):
    """Tell whether the way from one vertex to another goes along a direction."""
    ux, uy, uz = vertices[j] - vertices[i], vertices[j + 1] - vertices[i + 1], vertices[j + 2] - vertices[i + 2]
    along = x * ux + y * uy + z * uz
    if along <= 0.0:
        return False
    return along * along > LEANING * LEANING * (ux * ux + uy * uy + uz * uz) * (x * x + y * y + z * z)


@inlined
def behind_of(triangles, links, found, near, x, y, z, within):
    """Return the triangle a point is behind, of those found; -1 where it is in front of the nearest of them.

    Also where that one is farther than ``within``.
    """
    hidden = False
    for c in range(near):
        a = TRIANGLE * found[c]
        dx, dy, dz = x - triangles[a], y - triangles[a + 1], z - triangles[a + 2]
        if triangles[a + 9] * dx + triangles[a + 10] * dy + triangles[a + 11] * dz < 0.0:
            hidden = True
            break
    if not hidden:
        return -1
    nearest, side, behind = within, 0.0, -1
    for c in range(near):
        t = found[c]
        cx, cy, cz, part = nearest_on_triangle(triangles, t, x, y, z)
        dx, dy, dz = x - cx, y - cy, z - cz
        distance = sqrt(dx * dx + dy * dy + dz * dz)
        if distance >= nearest + LEAST_PART:
            continue
        above = triangles[TRIANGLE * t + 9] * dx + triangles[TRIANGLE * t + 10] * dy + triangles[TRIANGLE * t + 11] * dz
        if on_rim(links, t, part):
            above = distance
        if distance < nearest - LEAST_PART:
            nearest, side, behind = distance, above, t
        elif abs(above) > abs(side):
            side, behind = above, t
    return behind if side < 0.0 else -1


@inlined
def is_nearest_beneath(triangles, links, found, near, t, x, y, z):
    """Tell whether a point is behind a mesh, of which no triangle is nearer to it than t, of those found."""
    behind = behind_of(triangles, links, found, near, x, y, z, 1e300)
    if behind < 0:
        return False
    return distance_to(triangles, t, x, y, z) <= distance_to(triangles, behind, x, y, z) + LEAST_PART


@inlined
def distance_to(triangles, t, x, y, z):
    """Return how far (m) a point is from a triangle."""
    cx, cy, cz, _ = nearest_on_triangle(triangles, t, x, y, z)
    return sqrt((x - cx) * (x - cx) + (y - cy) * (y - cy) + (z - cz) * (z - cz))
