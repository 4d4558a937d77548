"""Polyhedra placed in the world: what balls, capsules, boxes and hulls are to the kernels of hulls."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS
from carom.systems.kernels.distance import outermost
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.narrow import BOX_SHAPE, POINT_SHAPE, SPHERE_SHAPE
from carom.systems.kernels.spatial import turn
from carom.systems.shapes.capsule import Capsule

CAPSULE_SHAPE = Capsule.number
POINT, SEGMENT, BOX = 0, 1, 2  # the polyhedra that come before those of geometries


@inlined
def polyhedron_of(shape, sx, sy, sz, geometry, polyhedron):
    """Return (number, scale along its axes, radius around it) of a shape; POINT and SEGMENT have no faces."""
    if shape in (SPHERE_SHAPE, POINT_SHAPE):
        return POINT, 0.0, 0.0, 0.0, sx
    if shape == CAPSULE_SHAPE:
        return SEGMENT, 0.0, 0.5 * sy, 0.0, sx
    if shape == BOX_SHAPE:
        return BOX, 0.5 * sx, 0.5 * sy, 0.5 * sz, 0.0
    return polyhedron[geometry], 1.0, 1.0, 1.0, 0.0


@inlined
def place_vertices(hulls, p, sx, sy, sz, x, y, z, qx, qy, qz, qw, v, at):
    """Write the vertices of polyhedron p, scaled, turned and moved, from ``at`` on; return where they end."""
    for k in range(hulls.vertex_start[p], hulls.vertex_start[p + 1]):
        vx, vy, vz = turn(
            qx, qy, qz, qw, sx * hulls.vertices[k, 0], sy * hulls.vertices[k, 1], sz * hulls.vertices[k, 2]
        )
        v[3 * at], v[3 * at + 1], v[3 * at + 2] = x + vx, y + vy, z + vz
        at += 1
    return at


@inlined
def place_faces(hulls, p, sx, sy, sz, x, y, z, qx, qy, qz, qw, planes, at):
    """Write the planes of polyhedron p, scaled, turned and moved, from ``at`` on; return where they end.

    Only what is aligned with its axes may be scaled: its normals stay, and its offsets grow with the axis.
    """
    for f in range(hulls.face_start[p], hulls.face_start[p + 1]):
        lx, ly, lz = hulls.normals[f, 0], hulls.normals[f, 1], hulls.normals[f, 2]
        nx, ny, nz = turn(qx, qy, qz, qw, lx, ly, lz)
        offset = hulls.offsets[f] * (lx * lx * sx + ly * ly * sy + lz * lz * sz)
        planes[4 * at], planes[4 * at + 1], planes[4 * at + 2] = nx, ny, nz
        planes[4 * at + 3] = offset + nx * x + ny * y + nz * z
        at += 1
    return at


@inlined
def face_towards(hulls, p, v, begin, end, planes, faces, x, y, z):
    """Return (face, cosine) of polyhedron p's face most turned to a direction, among those at its outermost vertex.

    Others may be turned there more and yet lie behind. Faces count from 0; -1 where there are none.
    """
    _, most = outermost(v, begin, end, x, y, z)
    best, cosine = -1, -2.0
    first = hulls.face_start[p]
    for f in range(hulls.face_start[p + 1] - first):
        plane = 4 * (faces + f)
        turned = planes[plane] * x + planes[plane + 1] * y + planes[plane + 2] * z
        if turned <= cosine:
            continue
        for corner in range(hulls.loop_start[first + f], hulls.loop_start[first + f + 1]):
            i = 3 * (begin + hulls.loop_vertex[corner])
            if v[i] * x + v[i + 1] * y + v[i + 2] * z >= most - BIAS:
                best, cosine = f, turned
                break
    return best, cosine
