"""Shares: with whose surface contact points go, over whose faces they glide."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import FACING, LEANING, WITHIN
from carom.systems.kernels.cores import CONE_SHAPE, CONVEX_SHAPE, CYLINDER_SHAPE
from carom.systems.kernels.frames import turned_back
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.narrow import BOX_SHAPE, PLANE_SHAPE, is_ball
from carom.systems.kernels.offsets import is_alike
from carom.systems.kernels.ray_colliders import FIELD_SHAPE, MESH_SHAPE


@woven
def find_shares(first, end, a, b, normal, shape, pose_rotation, share):
    """Write how much the contact points of colliders a and b go with b."""
    for c in range(first, end):
        if c > first and is_alike(c, c - 1, normal):
            share[c] = share[c - 1]
        else:
            flat_a, flat_b = is_flat(a, c, normal, shape, pose_rotation), is_flat(b, c, normal, shape, pose_rotation)
            share[c] = share_of_b(flat_a, flat_b)


@woven
def share_of_b(flat_a, flat_b):
    """Return how much a point goes with b rather than with a, over whose faces it glides where those are ``flat``."""
    share = 0.5
    if flat_a:
        share += 0.5
    if flat_b:
        share -= 0.5
    return share


@woven
def is_flat(i, c, normal, shape, pose_rotation):
    """Tell whether a collider turns a face to contact c, over which its point glides."""
    if shape[i] != BOX_SHAPE:
        return shape[i] == PLANE_SHAPE
    x, y, z = turned_back(pose_rotation, i, normal[c, 0], normal[c, 1], normal[c, 2])
    return is_along_axis(x, y, z, LEANING)


@woven
def is_flat_where_seated(i, c, lean, shape):
    """Tell whether collider i turns a face to contact c, whose normal ``lean`` has in its frame."""
    return shape[i] == PLANE_SHAPE or (
        shape[i] == BOX_SHAPE and is_along_axis(lean[c, 0], lean[c, 1], lean[c, 2], LEANING)
    )


@woven
def is_along_axis(x, y, z, leaning):
    """Tell whether a unit vector is along one of the axes, but for such a sine."""
    x, y, z = x * x, y * y, z * z
    return x + y + z - max(x, y, z) <= leaning * leaning


@woven
def is_round(i, shape):
    """Tell whether a collider is more than flat faces; a point is round, too."""
    return not (
        shape[i] == BOX_SHAPE or shape[i] == PLANE_SHAPE or shape[i] == CONVEX_SHAPE or is_land(i, shape)
    )  # fmt: skip


@woven
def shows_face(c, outward, share):
    """Tell whether contact c glides over a face of a collider, out of which its normal leads (1) or into it (-1)."""
    return share[c] == (1.0 if outward > 0.0 else 0.0)


@inlined
def find_faces(
    first, end, a, b, normal, point, shape, size, geometry, position, rotation, polyhedron, face_start, normals, share
):  # fmt: skip
    """Write of contacts of what is round that they glide over a face, where they do: to `FACING`, as they are found.

    Over an end of a cylinder or the base of a cone glides whoever touches it within its rim, over a face of a box or a
    hull what is round and does not show one.
    """
    for c in range(first, end):
        if c > first and is_alike(c, c - 1, normal):
            share[c] = share[c - 1]
            continue
        last = c + 1
        while last < end and is_alike(last, c, normal):
            last += 1
        of_a = is_on_end(a, b, c, last, 1.0, normal, point, shape, size, position, rotation)
        of_b = is_on_end(b, a, c, last, -1.0, normal, point, shape, size, position, rotation)
        if not (of_a or of_b):
            of_a = is_on_face(a, b, c, 1.0, normal, shape, geometry, rotation, polyhedron, face_start, normals)
            of_b = is_on_face(b, a, c, -1.0, normal, shape, geometry, rotation, polyhedron, face_start, normals)
        if of_a != of_b:
            share[c] = 1.0 if of_a else 0.0


@inlined
def is_on_end(i, o, c, last, outward, normal, point, shape, size, position, rotation):
    """Tell whether contacts c to ``last`` lie within the rim of an end of collider i, a cylinder or a cone."""
    if not (shape[i] == CYLINDER_SHAPE or shape[i] == CONE_SHAPE) or is_land(o, shape):
        return False
    x, y, z = turned_back(rotation, i, outward * normal[c, 0], outward * normal[c, 1], outward * normal[c, 2])
    if x * x + z * z > FACING * FACING or (shape[i] == CONE_SHAPE and y > 0.0):
        return False
    farthest = 0.0
    for k in range(c, last):
        x, _, z = turned_back(
            rotation, i, point[k, 0] - position[i, 0], point[k, 1] - position[i, 1], point[k, 2] - position[i, 2]
        )
        farthest = max(farthest, x * x + z * z)
    within = WITHIN * size[i, 0]
    return farthest < within * within


@inlined
def is_on_face(i, o, c, outward, normal, shape, geometry, rotation, polyhedron, face_start, normals):
    """Tell whether contact c of what is round, o, lies on a face of collider i, a box or a hull."""
    if not is_round(o, shape) or not (shape[i] == BOX_SHAPE or shape[i] == CONVEX_SHAPE):
        return False
    x, y, z = turned_back(rotation, i, outward * normal[c, 0], outward * normal[c, 1], outward * normal[c, 2])
    if shape[i] == BOX_SHAPE:
        return not is_ball(o, shape) and is_along_axis(x, y, z, FACING)  # what a ball touches is exact
    one = polyhedron[geometry[i]]
    for f in range(face_start[one], face_start[one + 1]):
        if x * normals[f, 0] + y * normals[f, 1] + z * normals[f, 2] > 1.0 - 0.5 * FACING * FACING:
            return True
    return False


@woven
def is_land(i, shape):
    """Tell whether a collider is of triangles."""
    return shape[i] == MESH_SHAPE or shape[i] == FIELD_SHAPE
