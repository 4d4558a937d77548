"""Cores: what a shape is around, by the point of it that is farthest along a direction.

A ball is a point with a radius around it and a capsule a segment; all other shapes are their own core, without one.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.narrow import BOX_SHAPE, PLANE_SHAPE, POINT_SHAPE, SPHERE_SHAPE
from carom.systems.kernels.polyhedra import CAPSULE_SHAPE
from carom.systems.kernels.spatial import product, turn
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid

CYLINDER_SHAPE, CONE_SHAPE, ELLIPSOID_SHAPE = Cylinder.number, Cone.number, Ellipsoid.number
CONVEX_SHAPE = Convex.number
POINT, SEGMENT, BOX, CYLINDER, CONE, ELLIPSOID, HULL, HALF_SPACE, NONE = range(9)

#: Numbers that tell of a core: kind, half extents along its axes (of round ones: radius, half height), radius around
#: it, number of its polyhedron and where its vertices begin and end. A half space has its normal and offset there.
CORE = 8
KIND, EXTENT, AROUND, POLYHEDRON, BEGIN, END = 0, 1, 4, 5, 6, 7
OFFSET = POLYHEDRON
#: Where the cores of a pair are; as plain numbers of Python Numba would compile what takes them for each of the two.
FIRST, SECOND = np.int64(0), np.int64(CORE)
#: Numbers that tell where the second core is, seen from the first: a rotation matrix by rows, then the position.
PLACE = 12
POSITION = 9


@inlined
def write_core(shape, size, geometry, row, hulls, core, at):
    """Write the core of a collider from ``at`` on."""
    kind, x, y, z, number, around = NONE, size[row, 0], size[row, 1], size[row, 2], 0.0, 0.0
    if shape[row] in (SPHERE_SHAPE, POINT_SHAPE):
        kind, x, y, z, around = POINT, 0.0, 0.0, 0.0, size[row, 0]
    elif shape[row] == CAPSULE_SHAPE:
        kind, x, y, z, around = SEGMENT, 0.0, 0.5 * size[row, 1], 0.0, size[row, 0]
    elif shape[row] == BOX_SHAPE:
        kind, x, y, z = BOX, 0.5 * x, 0.5 * y, 0.5 * z
    elif shape[row] == CYLINDER_SHAPE:
        kind, y, z = CYLINDER, 0.5 * y, x
    elif shape[row] == CONE_SHAPE:
        kind, y, z = CONE, 0.5 * y, x
    elif shape[row] == ELLIPSOID_SHAPE:
        kind = ELLIPSOID
    elif shape[row] == CONVEX_SHAPE:
        polyhedron = hulls.polyhedron[geometry[row]]
        kind, number = HULL, float(polyhedron)
        core[at + BEGIN], core[at + END] = hulls.vertex_start[polyhedron], hulls.vertex_start[polyhedron + 1]
    elif shape[row] == PLANE_SHAPE:
        kind, number = HALF_SPACE, size[row, 3]
    core[at + KIND], core[at + POLYHEDRON], core[at + AROUND] = kind, number, around
    core[at + EXTENT], core[at + EXTENT + 1], core[at + EXTENT + 2] = x, y, z


@inlined
def write_place(position, rotation, first, second, place):
    """Write where the second collider is, seen from the first."""
    px, py, pz, pw = -rotation[first, 0], -rotation[first, 1], -rotation[first, 2], rotation[first, 3]
    x, y, z, w = product(
        px, py, pz, pw, rotation[second, 0], rotation[second, 1], rotation[second, 2], rotation[second, 3]
    )
    place[0], place[3], place[6] = turn(x, y, z, w, 1.0, 0.0, 0.0)
    place[1], place[4], place[7] = turn(x, y, z, w, 0.0, 1.0, 0.0)
    place[2], place[5], place[8] = turn(x, y, z, w, 0.0, 0.0, 1.0)
    place[POSITION], place[POSITION + 1], place[POSITION + 2] = turn(
        px, py, pz, pw,
        position[second, 0] - position[first, 0],
        position[second, 1] - position[first, 1],
        position[second, 2] - position[first, 2],
    )  # fmt: skip


@inlined
def into(place, x, y, z):
    """Return a direction of the first frame in the second."""
    return (
        place[0] * x + place[3] * y + place[6] * z,
        place[1] * x + place[4] * y + place[7] * z,
        place[2] * x + place[5] * y + place[8] * z,
    )


@inlined
def out_of(place, x, y, z):
    """Return a direction of the second frame in the first."""
    return (
        place[0] * x + place[1] * y + place[2] * z,
        place[3] * x + place[4] * y + place[5] * z,
        place[6] * x + place[7] * y + place[8] * z,
    )


@woven
def farthest(core, at, vertices, x, y, z):
    """Return the point of the core at ``at`` that is farthest along a direction, both in its frame."""
    kind = int(core[at + KIND])
    a, b, c = core[at + EXTENT], core[at + EXTENT + 1], core[at + EXTENT + 2]
    if kind == HULL:
        best, most = 0, -1e300
        for k in range(int(core[at + BEGIN]), int(core[at + END])):
            along = vertices[k, 0] * x + vertices[k, 1] * y + vertices[k, 2] * z
            if along > most:
                best, most = k, along
        return vertices[best, 0], vertices[best, 1], vertices[best, 2]
    if kind in (CYLINDER, CONE, ELLIPSOID):
        return farthest_of_round(kind, a, b, c, x, y, z)
    return a if x >= 0.0 else -a, b if y >= 0.0 else -b, c if z >= 0.0 else -c


@woven
def farthest_of_round(kind, a, b, c, x, y, z):
    """Return the point of a cylinder, cone or ellipsoid of these extents that is farthest along a direction."""
    if kind == ELLIPSOID:
        u, v, w = a * x, b * y, c * z
        scale = 1.0 / sqrt(u * u + v * v + w * w)
        return u * scale * a, v * scale * b, w * scale * c
    across = sqrt(x * x + z * z)
    if kind == CONE and 2.0 * b * y > a * across:
        return 0.0, b, 0.0
    end = b if kind == CYLINDER and y >= 0.0 else -b
    if across > 0.0:
        return a * x / across, end, a * z / across
    return a, end, 0.0


@inlined
def most_overlap(core, place, vertices, x, y, z):
    """Return (w, a): the point of the difference of two cores, first less second, farthest along a direction.

    ``a`` is the point of the first that it comes from; w . direction is how far the two overlap along it.
    """
    ax, ay, az = farthest(core, FIRST, vertices, x, y, z)
    lx, ly, lz = into(place, -x, -y, -z)
    lx, ly, lz = farthest(core, SECOND, vertices, lx, ly, lz)
    bx, by, bz = out_of(place, lx, ly, lz)
    bx, by, bz = bx + place[POSITION], by + place[POSITION + 1], bz + place[POSITION + 2]
    return ax - bx, ay - by, az - bz, ax, ay, az
