"""Narrow phase of balls, points, capsules, boxes and hulls against hulls, and of hulls against half spaces."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import OVER_EDGE
from carom.systems.kernels.areas import points_of_area
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.distance import APART, FAR, distance_apart
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.low_points import reduce_lows
from carom.systems.kernels.polyhedra import place_faces, place_vertices, polyhedron_of
from carom.systems.kernels.separation import most_apart
from carom.systems.kernels.spatial import turn
from carom.systems.kernels.writing import write_points


@inlined
def most_of(starts):
    """Return the largest step of an array that rises."""
    most = 0
    for k in range(1, len(starts)):
        most = max(most, starts[k] - starts[k - 1])
    return most


@inlined
def comes_first(p, i, q, j, position, rotation):
    """Tell whether polyhedron p at row i is measured before q at row j, whatever the caller's order.

    Swapping the two then flips normals and changes no bit else. Axes along which they are level to OVER_EDGE are asked
    last, so that a trembling pair keeps its order, which its features show.
    """
    if p != q:
        return p < q
    for least in (OVER_EDGE, 0.0):
        for d in range(3):
            apart = position[j, d] - position[i, d]
            if abs(apart) > least:
                return apart > 0.0
    for d in range(4):
        if rotation[i, d] != rotation[j, d]:
            return rotation[i, d] < rotation[j, d]
    return True


@shared("start", "count", "apart", "feature", "normal", "depth", "point", makes_arrays=True)
def measure_hulls(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs whose second collider is a hull, in the form of `measure_balls`.

    Cores (point, segment, polyhedron) that are apart have their exact distance. Those that overlap are parted along
    the face's or edges' normal where they overlap least, at any depth; concentric ones by the first such face. The
    contact's points are where the faces turned to each other lie one over the other, seen along the normal.
    """
    corners, faces = most_of(hulls.vertex_start), most_of(hulls.face_start)
    most = 2 * most_of(hulls.loop_start) + 2
    v, planes = np.empty(6 * corners), np.empty(8 * faces)
    near = np.empty(most_of(hulls.edge_start), np.int64)
    corner, name, weight = np.empty(12), np.empty(8, np.int64), np.empty(4)
    polygon, tag = np.empty(6 * most), np.empty(2 * most, np.int64)
    most += corners
    place, gaps, names = np.empty(3 * most), np.empty(most), np.empty(most, np.int64)
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for k in range(begin, end):
        pair, a, b = which[k], first[k], second[k]
        start[pair] = taken
        p, ax, ay, az, radius = polyhedron_of(
            shape[a], size[a, 0], size[a, 1], size[a, 2], geometry[a], hulls.polyhedron
        )
        q, bx, by, bz, _ = polyhedron_of(shape[b], size[b, 0], size[b, 1], size[b, 2], geometry[b], hulls.polyhedron)
        side = 1.0
        if not comes_first(p, a, q, b, position, rotation):
            a, b, p, q, ax, ay, az, bx, by, bz, side = b, a, q, p, bx, by, bz, ax, ay, az, -1.0
        x, y, z = position[a, 0], position[a, 1], position[a, 2]
        middle = place_vertices(
            hulls, p, ax, ay, az, 0.0, 0.0, 0.0,
            rotation[a, 0], rotation[a, 1], rotation[a, 2], rotation[a, 3], v, 0,
        )  # fmt: skip
        end = place_vertices(
            hulls, q, bx, by, bz, position[b, 0] - x, position[b, 1] - y, position[b, 2] - z,
            rotation[b, 0], rotation[b, 1], rotation[b, 2], rotation[b, 3], v, middle,
        )  # fmt: skip
        reach = reaches[pair] + radius
        state, gap, nx, ny, nz, px, py, pz = distance_apart(v, middle, end, reach, corner, name, weight)
        apart[pair] = gap - radius
        if state == FAR:
            continue
        split = place_faces(
            hulls, p, ax, ay, az, 0.0, 0.0, 0.0,
            rotation[a, 0], rotation[a, 1], rotation[a, 2], rotation[a, 3], planes, 0,
        )  # fmt: skip
        every = place_faces(
            hulls, q, bx, by, bz, position[b, 0] - x, position[b, 1] - y, position[b, 2] - z,
            rotation[b, 0], rotation[b, 1], rotation[b, 2], rotation[b, 3], planes, split,
        )  # fmt: skip
        edges_p, edges_q = hulls.edge_start[p], hulls.edge_start[q]
        if state != APART:
            gap, nx, ny, nz, px, py, pz = most_apart(
                v, planes, middle, end, split, every, hulls.edges,
                edges_p, hulls.edge_start[p + 1], edges_q, hulls.edge_start[q + 1], near,
            )  # fmt: skip
        if gap > reach:
            continue
        # Edges are labelled in the caller's order, so that the order of measuring never shows in features.
        labels_p, labels_q = 0, hulls.edge_start[p + 1] - edges_p
        labels = labels_q + hulls.edge_start[q + 1] - edges_q
        if side < 0.0:
            labels_p, labels_q = labels - labels_q, 0
        found = points_of_area(
            hulls, p, q, v, middle, end, planes, split, gap, nx, ny, nz, px, py, pz, reach,
            labels_p, labels_q, labels, polygon, tag, place, gaps, names,
        )  # fmt: skip
        found = reduce_lows(place, gaps, names, found, nx, ny, nz)
        if found == 1:
            names[0] = 0  # a lone point is the pair itself, however the bodies roll
        count[pair] = found
        taken = write_points(
            place, gaps, names, found, x, y, z, nx, ny, nz, side, radius, 0.0, taken, feature, normal, depth, point
        )


@shared("start", "count", "feature", "normal", "depth", "point", makes_arrays=True)
def measure_hulls_on_planes(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of a hull and a half space, in the form of `measure_balls`; points are the hull's vertices."""
    corners = most_of(hulls.vertex_start)
    v, place, gaps, names = np.empty(3 * corners), np.empty(3 * corners), np.empty(corners), np.empty(corners, np.int64)
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for k in range(begin, end):
        pair, a, b = which[k], first[k], second[k]
        start[pair] = taken
        x, y, z = position[a, 0], position[a, 1], position[a, 2]
        end = place_vertices(
            hulls, hulls.polyhedron[geometry[a]], 1.0, 1.0, 1.0, 0.0, 0.0, 0.0,
            rotation[a, 0], rotation[a, 1], rotation[a, 2], rotation[a, 3], v, 0,
        )  # fmt: skip
        nx, ny, nz = turn(
            rotation[b, 0], rotation[b, 1], rotation[b, 2], rotation[b, 3], size[b, 0], size[b, 1], size[b, 2]
        )
        height = nx * (x - position[b, 0]) + ny * (y - position[b, 1]) + nz * (z - position[b, 2]) - size[b, 3]
        found = 0
        for c in range(end):
            gap = height + nx * v[3 * c] + ny * v[3 * c + 1] + nz * v[3 * c + 2]
            if gap <= reaches[pair]:
                gaps[found], names[found] = gap, c
                place[3 * found], place[3 * found + 1], place[3 * found + 2] = v[3 * c], v[3 * c + 1], v[3 * c + 2]
                found += 1
        found = reduce_lows(place, gaps, names, found, -nx, -ny, -nz)
        count[pair] = found
        taken = write_points(
            place, gaps, names, found, x, y, z, -nx, -ny, -nz, 1.0, 0.0, 0.0, taken, feature, normal, depth, point
        )
