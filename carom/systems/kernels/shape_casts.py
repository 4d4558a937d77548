"""Shapes cast at colliders."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.approach import BEGUN, MISSED, TOUCHED, approach, approach_half_space
from carom.systems.kernels.cores import (
    AROUND,
    BEGIN,
    CORE,
    END,
    FIRST,
    HALF_SPACE,
    HULL,
    KIND,
    PLACE,
    POSITION,
    SECOND,
    farthest,
    into,
    write_core,
    write_place,
)
from carom.systems.kernels.frames import turned
from carom.systems.kernels.kernel import inlined, kernel, woven
from carom.systems.kernels.mesh_tree import FEW, TRIANGLE, all_triangles
from carom.systems.kernels.nearing import MOST_STEPS
from carom.systems.kernels.ray_colliders import FIELD_SHAPE, MESH_SHAPE
from carom.systems.kernels.spatial import turn


@inlined
def sweep_bounds(core, place, vertices, ux, uy, uz, limit, low, high):
    """Write the bounds of all that the second core passes through, in the frame of the first."""
    for d in range(3):
        lx, ly, lz = into(place, 1.0 if d == 0 else 0.0, 1.0 if d == 1 else 0.0, 1.0 if d == 2 else 0.0)
        px, py, pz = farthest(core, SECOND, vertices, lx, ly, lz)
        up = lx * px + ly * py + lz * pz + core[CORE + AROUND]
        px, py, pz = farthest(core, SECOND, vertices, -lx, -ly, -lz)
        down = lx * px + ly * py + lz * pz - core[CORE + AROUND]
        way = limit * (ux if d == 0 else uy if d == 1 else uz)
        low[d], high[d] = place[POSITION + d] + down + min(way, 0.0), place[POSITION + d] + up + max(way, 0.0)


@woven
def approach_triangle(core, place, vertices, triangles, t, ux, uy, uz, limit, mirrored, corner, name, weight, seen):
    """Return what `approach` does, onto a triangle of a mesh, whose corners are the last of ``vertices``."""
    k, last = TRIANGLE * t, len(vertices) - 3
    for c in range(9):
        vertices[last + c // 3, c % 3] = triangles[k + c]
    state, way, nx, ny, nz, px, py, pz = approach(
        core, place, vertices, ux, uy, uz, limit, mirrored, corner, name, weight, seen
    )
    if state == BEGUN:  # it touches: what leads in or out is told by the triangle
        nx, ny, nz = triangles[k + 9], triangles[k + 10], triangles[k + 11]
        px, py, pz = place[POSITION], place[POSITION + 1], place[POSITION + 2]
        above = nx * (px - triangles[k]) + ny * (py - triangles[k + 1]) + nz * (pz - triangles[k + 2])
        px, py, pz = px - above * nx, py - above * ny, pz - above * nz
        state = TOUCHED if nx * ux + ny * uy + nz * uz < 0.0 else MISSED
    return state, way, nx, ny, nz, px, py, pz


@kernel("position", "rotation", "row", "distance", "normal", "point", "part", makes_arrays=True)
def cast_shapes(
    pairs, origin, turns, direction, shape, size, geometry, position, rotation, hulls, meshes, room,
    row, distance, normal, point, part,
):  # fmt: skip
    """Write what a shape meets first on its way from each place, among ``pairs`` (query, row), sorted.

    The shape that is cast is the last row of the columns; where it meets nothing within ``distance``, nothing is
    written. A part is the triangle of a mesh, -1 of all else. ``room`` are the vertices of all hulls, and three more.
    """
    core, mirrored, place, low, high = np.zeros(2 * CORE), np.zeros(2 * CORE), np.empty(PLACE), np.empty(3), np.empty(3)
    corner, name, weight, seen = np.empty(12), np.empty(8, np.int64), np.empty(4), np.empty(3 * MOST_STEPS)
    found = np.empty(FEW, np.uint32)
    root, bounds, nodes, triangles, links = meshes.root, meshes.bounds, meshes.nodes, meshes.triangles, meshes.links
    own = len(shape) - 1
    write_core(shape, size, geometry, own, hulls, core, SECOND)
    for p in range(len(pairs)):
        q, i = pairs[p, 0], pairs[p, 1]
        for d in range(3):
            position[own, d] = origin[q, d]
        for d in range(4):
            rotation[own, d] = turns[q, d]
        write_core(shape, size, geometry, i, hulls, core, FIRST)
        write_place(position, rotation, i, own, place)
        ux, uy, uz = turn(
            -rotation[i, 0], -rotation[i, 1], -rotation[i, 2], rotation[i, 3],
            direction[q, 0], direction[q, 1], direction[q, 2],
        )  # fmt: skip
        limit, face = distance[q], -1
        state, way, nx, ny, nz, px, py, pz = MISSED, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0
        if shape[i] in (MESH_SHAPE, FIELD_SHAPE):
            core[KIND], core[BEGIN], core[END], core[AROUND] = HULL, len(room) - 3, len(room), 0.0
            sweep_bounds(core, place, room, ux, uy, uz, limit, low, high)
            count, found = all_triangles(
                root[geometry[i]], bounds, nodes, triangles, low[0], low[1], low[2], high[0], high[1], high[2], found
            )
            for c in range(count):
                t = found[c]
                met, at, mx, my, mz, qx, qy, qz = approach_triangle(
                    core, place, room, triangles, t, ux, uy, uz, limit, mirrored, corner, name, weight, seen
                )
                if met == TOUCHED and (at < limit or state == MISSED):
                    state, way, limit, face = met, at, at, links[8 * t + 7]
                    nx, ny, nz, px, py, pz = mx, my, mz, qx, qy, qz
        elif core[KIND] == HALF_SPACE:
            state, way, nx, ny, nz, px, py, pz = approach_half_space(core, place, room, ux, uy, uz, limit)
        else:
            state, way, nx, ny, nz, px, py, pz = approach(
                core, place, room, ux, uy, uz, limit, mirrored, corner, name, weight, seen
            )
        if state == MISSED or (way == distance[q] and row[q] >= 0):
            continue
        row[q], distance[q], part[q] = i, way, face
        normal[q, 0], normal[q, 1], normal[q, 2] = turned(rotation, i, nx, ny, nz)
        px, py, pz = turned(rotation, i, px, py, pz)
        point[q, 0], point[q, 1], point[q, 2] = position[i, 0] + px, position[i, 1] + py, position[i, 2] + pz
