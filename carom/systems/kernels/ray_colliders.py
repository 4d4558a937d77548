"""Where a ray meets one collider, of whatever shape, and which way the collider faces there."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import ON_SURFACE
from carom.systems.kernels.cores import CONE_SHAPE, CYLINDER_SHAPE, ELLIPSOID_SHAPE
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.narrow import BOX_SHAPE, PLANE_SHAPE, POINT_SHAPE, SPHERE_SHAPE
from carom.systems.kernels.polyhedra import CAPSULE_SHAPE
from carom.systems.kernels.ray_meshes import first_triangle
from carom.systems.kernels.ray_solids import (
    BOTTOM,
    FAR,
    SIDE,
    through_ball,
    through_box,
    through_capsule,
    through_cone,
    through_cylinder,
    through_ellipsoid,
    through_half_space,
)
from carom.systems.kernels.spatial import turn
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh

MESH_SHAPE, FIELD_SHAPE = Mesh.number, HeightField.number
WITHIN = -1  # the face of a ray that begins inside
ASIDE_X, ASIDE_Y, ASIDE_Z = 0.36, 0.48, 0.8  # a direction that few edges have


@inlined
def seen_from(ox, oy, oz, dx, dy, dz, px, py, pz, qx, qy, qz, qw):
    """Return (start, x, u): a ray in the frame of what is at p, turned by q.

    The line is x + s u, x nearest to the origin of the frame, and the ray begins at ``start``.
    """
    x, y, z = ox - px, oy - py, oz - pz
    start = x * dx + y * dy + z * dz
    x, y, z = turn(-qx, -qy, -qz, qw, x - start * dx, y - start * dy, z - start * dz)
    ux, uy, uz = turn(-qx, -qy, -qz, qw, dx, dy, dz)
    return start, x, y, z, ux, uy, uz


@woven
def through_hull(normals, offsets, begin, end, x, y, z, dx, dy, dz):
    """Return (enter, leave, face) of a polyhedron: what the planes of its faces leave of a line."""
    enter, leave, face = -FAR, FAR, 0
    for f in range(begin, end):
        nx, ny, nz = normals[f, 0], normals[f, 1], normals[f, 2]
        first, last = through_half_space(nx, ny, nz, offsets[f], x, y, z, dx, dy, dz)
        if first > enter:
            enter, face = first, f - begin
        leave = min(leave, last)
    return enter, leave, face


@inlined
def through_solid(shape, a, b, c, d, x, y, z, dx, dy, dz):
    """Return (enter, leave, face) of a convex collider whose size column is (a, b, c, d)."""
    if shape == BOX_SHAPE:
        return through_box(0.5 * a, 0.5 * b, 0.5 * c, x, y, z, dx, dy, dz)
    if shape == CYLINDER_SHAPE:
        return through_cylinder(a, 0.5 * b, x, y, z, dx, dy, dz)
    if shape == CONE_SHAPE:
        return through_cone(a, 0.5 * b, x, y, z, dx, dy, dz)
    enter, leave = FAR, -FAR
    if shape in (SPHERE_SHAPE, POINT_SHAPE):
        enter, leave = through_ball(a, x, y, z, dx, dy, dz)
    elif shape == CAPSULE_SHAPE:
        enter, leave = through_capsule(a, 0.5 * b, x, y, z, dx, dy, dz)
    elif shape == ELLIPSOID_SHAPE:
        enter, leave = through_ellipsoid(a, b, c, x, y, z, dx, dy, dz)
    elif shape == PLANE_SHAPE:
        enter, leave = through_half_space(a, b, c, d, x, y, z, dx, dy, dz)
    return enter, leave, SIDE


@woven
def meet_mesh(
    is_field, node, bounds, b, boxes, inside, blocks, corners, x, y, z, dx, dy, dz, start, limit,
    stack, ahead, seen, lanes,
):  # fmt: skip
    """Return (s, triangle) where a ray from ``start`` on meets a mesh of bounds at b, WITHIN where it begins inside.

    A ray that leads out first may begin inside, or graze an edge: what it sees in another direction tells. Land is
    solid down to its lower end, so whoever is beneath it sees its back straight above.
    """
    px, py, pz = x + start * dx, y + start * dy, z + start * dz
    beside = px < bounds[b] or px > bounds[b + 3] or pz < bounds[b + 2] or pz > bounds[b + 5]
    out = beside or py > bounds[b + 4] or (py < bounds[b + 1] and not is_field)
    look = 2 if out else 1 if is_field else 0  # 0: ahead, 1: elsewhere, 2: ahead for fronts
    while True:
        vx, vy, vz, ux, uy, uz, low = x, y, z, dx, dy, dz, start
        high = limit if out or look == 2 else FAR
        if look == 1:
            vx, vy, vz, low = px, py, pz, 0.0
            ux, uy, uz = (0.0, 1.0, 0.0) if is_field else (ASIDE_X, ASIDE_Y, ASIDE_Z)
        s, found, back = first_triangle(
            node, boxes, inside, blocks, corners, vx, vy, vz, ux, uy, uz, low, high, look == 2,
            stack, ahead, seen, lanes,
        )  # fmt: skip
        if look == 2 or (look == 0 and not back):
            return (s, found) if s <= limit else (FAR, -1)
        if look == 1 and back:
            return start, WITHIN
        look += 1


@inlined
def facing(shape, a, b, c, face, x, y, z):
    """Return the outward unit normal of a shape without corners or of a box at a point of its surface."""
    if shape == BOX_SHAPE:
        sign = 1.0 if face % 2 == 1 else -1.0
        return sign if face < 2 else 0.0, sign if 2 <= face < 4 else 0.0, sign if face >= 4 else 0.0
    if shape == PLANE_SHAPE:
        return a, b, c
    if shape in (CYLINDER_SHAPE, CONE_SHAPE) and face != SIDE:
        return 0.0, -1.0 if face == BOTTOM else 1.0, 0.0
    if shape == CAPSULE_SHAPE:
        y -= min(max(y, -0.5 * b), 0.5 * b)
    elif shape == CYLINDER_SHAPE:
        y = 0.0
    elif shape == CONE_SHAPE:
        y = a / b * sqrt(x * x + z * z)
    elif shape == ELLIPSOID_SHAPE:
        x, y, z = x / (a * a), y / (b * b), z / (c * c)
    length = sqrt(x * x + y * y + z * z)
    if not length > 0.0:
        return 0.0, 1.0, 0.0
    return x / length, y / length, z / length


@inlined
def where_met(enter, leave, face, start, limit):
    """Return (s, face) where a ray from ``start`` on meets a solid its line runs through; at FAR where it misses."""
    if enter > leave or leave <= start + ON_SURFACE or enter > limit:
        return FAR, SIDE
    if enter < start - ON_SURFACE:
        return start, WITHIN
    return max(enter, start), face
