"""Outlines: the face, straight line or point of a core that meets another body along a direction."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, UPRIGHT
from carom.systems.kernels.cores import (
    BOX,
    CONE,
    CORE,
    CYLINDER,
    EXTENT,
    HULL,
    KIND,
    POLYHEDRON,
    POSITION,
    SEGMENT,
    farthest,
    into,
    out_of,
)
from carom.systems.kernels.kernel import inlined
from carom.systems.shapes.rim import RIM_NUMBERS, RIM_POINTS, RIM_TURNS

LABELS = 4096  # more than any outline has edges; those of the second body are numbered on from here


@inlined
def outline(core, at, place, hulls, x, y, z, polygon, tag, plane):
    """Write what a core turns to a direction of the first frame; return (number of points, cosine of how much).

    Three points and more are a face, counter-clockwise from outside, whose normal and offset ``plane`` gets; two are
    the ends of a line, one a point alone. Each point has the label of the edge that leaves it.
    """
    second = at == CORE
    lx, ly, lz = into(place, x, y, z) if second else (x, y, z)
    kind = int(core[at + KIND])
    if kind == BOX:
        count, cosine = box_outline(core, at, lx, ly, lz, polygon, tag, plane)
    elif kind in (CYLINDER, CONE, SEGMENT):
        count, cosine = round_outline(core, at, kind, lx, ly, lz, polygon, tag, plane)
    elif kind == HULL:
        count, cosine = hull_outline(core, at, hulls, lx, ly, lz, polygon, tag, plane)
    else:
        polygon[0], polygon[1], polygon[2] = farthest(core, at, hulls.vertices, lx, ly, lz)
        count, cosine, tag[0] = 1, 0.0, 0
    if second:
        plane[0], plane[1], plane[2] = out_of(place, plane[0], plane[1], plane[2])
        for k in range(3):
            plane[3] += plane[k] * place[POSITION + k]
        for k in range(count):
            i = 3 * k
            lx, ly, lz = out_of(place, polygon[i], polygon[i + 1], polygon[i + 2])
            polygon[i], polygon[i + 1], polygon[i + 2] = (
                lx + place[POSITION],
                ly + place[POSITION + 1],
                lz + place[POSITION + 2],
            )
            tag[k] += LABELS
    return count, cosine


@inlined
def box_outline(core, at, x, y, z, polygon, tag, plane):
    """Write the face of a box turned most to a direction; edges are numbered from 0 to 11."""
    face, most, turned = 0, abs(x), x
    if abs(y) > most + BIAS:
        face, most, turned = 1, abs(y), y
    if abs(z) > most + BIAS:
        face, most, turned = 2, abs(z), z
    sign = 1.0 if turned > 0.0 else -1.0
    u, v = (face + 1) % 3, (face + 2) % 3
    for k in range(4):
        right, up = k in (1, 2), k in (2, 3)
        if sign < 0.0:
            right, up = up, right
        polygon[3 * k + face] = sign * core[at + EXTENT + face]
        polygon[3 * k + u] = core[at + EXTENT + u] if right else -core[at + EXTENT + u]
        polygon[3 * k + v] = core[at + EXTENT + v] if up else -core[at + EXTENT + v]
        # The edge that leaves the corner is along u and keeps v, or the other way round.
        along_u = (k % 2 == 0) if sign > 0.0 else (k % 2 == 1)
        along, kept, kept_up = (u, v, up) if along_u else (v, u, right)
        first_kept, second_kept = (kept_up, sign > 0.0) if kept == (along + 1) % 3 else (sign > 0.0, kept_up)
        tag[k] = 4 * along + (1 if first_kept else 0) + (2 if second_kept else 0)
    plane[0], plane[1], plane[2] = 0.0, 0.0, 0.0
    plane[face], plane[3] = sign, core[at + EXTENT + face]
    return 4, most


@inlined
def hull_outline(core, at, hulls, x, y, z, polygon, tag, plane):
    """Write the face of a hull turned most to a direction, among those at its outermost vertex."""
    number = int(core[at + POLYHEDRON])
    first_vertex = hulls.vertex_start[number]
    most = -1e300
    for k in range(first_vertex, hulls.vertex_start[number + 1]):
        most = max(most, hulls.vertices[k, 0] * x + hulls.vertices[k, 1] * y + hulls.vertices[k, 2] * z)
    best, cosine = hulls.face_start[number], -2.0
    for f in range(hulls.face_start[number], hulls.face_start[number + 1]):
        turned = hulls.normals[f, 0] * x + hulls.normals[f, 1] * y + hulls.normals[f, 2] * z
        if turned <= cosine:
            continue
        for corner in range(hulls.loop_start[f], hulls.loop_start[f + 1]):
            k = first_vertex + hulls.loop_vertex[corner]
            if hulls.vertices[k, 0] * x + hulls.vertices[k, 1] * y + hulls.vertices[k, 2] * z >= most - BIAS:
                best, cosine = f, turned
                break
    count = 0
    for corner in range(hulls.loop_start[best], hulls.loop_start[best + 1]):
        k = first_vertex + hulls.loop_vertex[corner]
        for d in range(3):
            polygon[3 * count + d] = hulls.vertices[k, d]
        tag[count] = hulls.loop_edge[corner]
        count += 1
    for d in range(3):
        plane[d] = hulls.normals[best, d]
    plane[3] = hulls.offsets[best]
    return count, cosine


@inlined
def round_outline(core, at, kind, x, y, z, polygon, tag, plane):
    """Write the end of a cylinder or cone, as a polygon whose first corner is farthest, or the line of its side.

    Upright ones have corners that stay; a capsule has its axis. Lines are numbered apart from the corners of ends.
    """
    radius, half = core[at + EXTENT], core[at + EXTENT + 1]
    across = sqrt(x * x + z * z)
    flat, side = abs(y), across
    if kind == CONE:
        scale = 1.0 / sqrt(4.0 * half * half + radius * radius)
        flat, side = -y, (2.0 * half * across + radius * y) * scale
    if kind == SEGMENT or side >= flat:
        ux, uz = (radius * x / across, radius * z / across) if across > 0.0 else (radius, 0.0)
        top = 0.0 if kind == CONE else 1.0
        polygon[0], polygon[1], polygon[2] = ux, -half, uz
        polygon[3], polygon[4], polygon[5] = top * ux, half, top * uz
        tag[0], tag[1] = 2 * RIM_POINTS, 2 * RIM_POINTS + 1
        return 2, side
    first_x, first_z = (x / across, z / across) if across > UPRIGHT else (1.0, 0.0)
    sign = 1.0 if y > 0.0 else -1.0
    for k in range(RIM_POINTS):
        cosine, sine = RIM_TURNS[k]
        sine *= -sign  # counter-clockwise from outside
        polygon[3 * k] = radius * (cosine * first_x - sine * first_z)
        polygon[3 * k + 1] = sign * half
        polygon[3 * k + 2] = radius * (cosine * first_z + sine * first_x)
        tag[k] = RIM_NUMBERS[k] if sign < 0.0 else RIM_POINTS + RIM_NUMBERS[k]
    plane[0], plane[1], plane[2], plane[3] = 0.0, sign, 0.0, half
    return RIM_POINTS, flat
