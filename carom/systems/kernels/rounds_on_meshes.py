"""Narrow phase of cylinders, cones and ellipsoids against meshes."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import FLAT_COSINE, SAME_PLACE
from carom.systems.kernels.cores import (
    CORE,
    ELLIPSOID,
    EXTENT,
    KIND,
    PLACE,
    POSITION,
    SECOND,
    farthest,
    into,
    out_of,
    write_core,
    write_place,
)
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.mesh_areas import MOST_CORNERS, points_over_triangle
from carom.systems.kernels.mesh_points import (
    MOST_MESH_POINTS,
    WIDTH,
    add_point,
    as_deep_as,
    choose_points,
    write_chosen,
)
from carom.systems.kernels.mesh_surface import behind_of
from carom.systems.kernels.mesh_tree import FEW, TRIANGLE, all_triangles, grown
from carom.systems.kernels.outlines import outline
from carom.systems.kernels.rounds_and_triangles import NOTHING, ON_CORNER, ON_EDGE, ON_FACE, parted_from_triangle
from carom.systems.kernels.rounds_on_edges import points_on_edge
from carom.systems.shapes.rim import RIM_NUMBERS, RIM_POINTS


@shared("start", "count", "feature", "normal", "depth", "point", makes_arrays=True)
def measure_rounds_on_meshes(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of a cylinder, cone or ellipsoid and a mesh, in the form of `measure_balls`.

    As `measure_solids_on_meshes` does, but by the solids' farthest points along any direction, not by corners.
    """
    triangles, links, vertices, fan_start, fan = (
        meshes.triangles, meshes.links, meshes.vertices, meshes.fan_start, meshes.fan,
    )  # fmt: skip
    root, bounds, nodes = meshes.root, meshes.bounds, meshes.nodes
    core, place, low, high = np.zeros(2 * CORE), np.empty(PLACE), np.empty(3), np.empty(3)
    most = 2 * RIM_POINTS + 8
    v, tag, plane, corners = np.empty(3 * most), np.empty(most, np.int64), np.zeros(4), np.arange(RIM_POINTS)
    polygon, tags = np.empty(6 * most), np.empty(4 * most, np.int64)
    line, spot, parted, sides = np.empty(6), np.empty(6), np.empty(2), np.empty(2, np.int64)
    found = np.empty(FEW, np.uint32)
    points, names, kept = np.empty(WIDTH * FEW), np.empty(FEW, np.int64), np.empty(MOST_MESH_POINTS, np.int64)
    place, gaps, alike = np.empty(3 * FEW), np.empty(FEW), np.empty(FEW, np.int64)
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for index in range(begin, end):
        pair, b, m = which[index], first[index], second[index]
        start[pair] = taken
        write_core(shape, size, geometry, b, hulls, core, SECOND)
        write_place(position, rotation, m, b, place)
        x, y, z, reach = place[POSITION], place[POSITION + 1], place[POSITION + 2], reaches[pair]
        width = 0.0
        for d in range(3):
            lx, ly, lz = into(place, 1.0 if d == 0 else 0.0, 1.0 if d == 1 else 0.0, 1.0 if d == 2 else 0.0)
            px, py, pz = farthest(core, SECOND, hulls.vertices, lx, ly, lz)
            up = lx * px + ly * py + lz * pz
            px, py, pz = farthest(core, SECOND, hulls.vertices, -lx, -ly, -lz)
            down = lx * px + ly * py + lz * pz
            low[d], high[d] = place[POSITION + d] + down - reach, place[POSITION + d] + up + reach
            width += 0.25 * (up - down) * (up - down)
        width = sqrt(width)
        p, q, r = core[CORE + EXTENT], core[CORE + EXTENT + 1], core[CORE + EXTENT + 2]
        farthest_corner = max(p, q, r) if core[CORE + KIND] == ELLIPSOID else sqrt(p * p + q * q)
        near, found = all_triangles(
            root[geometry[m]], bounds, nodes, triangles, low[0], low[1], low[2], high[0], high[1], high[2], found
        )
        behind = behind_of(triangles, links, found, near, x, y, z, farthest_corner + reach)
        touching = 0
        if behind >= 0:
            a = TRIANGLE * behind
            nx, ny, nz = triangles[a + 9], triangles[a + 10], triangles[a + 11]
            level = nx * triangles[a] + ny * triangles[a + 1] + nz * triangles[a + 2]
            end, _ = outline(core, SECOND, place, hulls, -nx, -ny, -nz, v, tag, plane)
            for i in range(end):
                gap = nx * v[3 * i] + ny * v[3 * i + 1] + nz * v[3 * i + 2] - level
                if gap <= reach:
                    half = 0.5 * gap
                    touching = add_point(
                        points, names, touching, nx, ny, nz,
                        v[3 * i] - half * nx, v[3 * i + 1] - half * ny, v[3 * i + 2] - half * nz, gap, RIM_NUMBERS[i],
                    )  # fmt: skip
            near = 0
        for c in range(near):
            t = found[c]
            kind, gap, nx, ny, nz, edge, px, py, pz = parted_from_triangle(
                core, place, hulls.vertices, triangles, links, vertices, fan_start, fan, t, reach, farthest_corner
            )
            a = TRIANGLE * t
            hidden = (
                triangles[a + 9] * (x - triangles[a])
                + triangles[a + 10] * (y - triangles[a + 1])
                + triangles[a + 11] * (z - triangles[a + 2])
            ) < 0.0
            if kind == NOTHING or (hidden and (kind == ON_FACE or gap < -SAME_PLACE * width)):
                continue
            while touching + most > len(names):
                names, points = grown(names), grown(points)
            before = touching
            # All of an area that n is all but square to is as near, and not one end of it or the other.
            if nx * triangles[a + 9] + ny * triangles[a + 10] + nz * triangles[a + 11] >= FLAT_COSINE:
                end, _ = outline(core, SECOND, place, hulls, -nx, -ny, -nz, v, tag, plane)
                touching = points_over_triangle(
                    v, corners, 0, end, triangles, links, vertices, t, 0.0, reach, found, near,
                    polygon, tags, most, points, names, touching,
                )  # fmt: skip
                for i in range(before, touching):
                    corner = names[i] % MOST_CORNERS
                    names[i] += RIM_NUMBERS[corner] - corner
                if kind != ON_FACE:
                    as_deep_as(points, before, touching, nx, ny, nz, gap)
            if kind == ON_EDGE and touching == before:
                touching = points_on_edge(
                    core, place, hulls, triangles, links, t, edge, nx, ny, nz, gap, px, py, pz, reach,
                    v, tag, plane, line, spot, parted, sides, points, names, touching,
                )  # fmt: skip
            elif kind == ON_CORNER and touching == before:
                lx, ly, lz = into(place, nx, ny, nz)
                half = 0.5 * gap
                px, py, pz = out_of(place, px - half * lx, py - half * ly, pz - half * lz)
                touching = add_point(
                    points, names, touching, nx, ny, nz, x + px, y + py, z + pz, gap,
                    MOST_CORNERS + 16 * MOST_CORNERS * links[8 * t + 7],
                )  # fmt: skip
        while touching > len(alike):
            place, gaps, alike = grown(place), grown(gaps), grown(alike)
        chosen = choose_points(points, names, touching, SAME_PLACE * width, 0.0, kept, place, gaps, alike)
        count[pair] = chosen
        taken = write_chosen(
            points, names, kept, chosen, position[m, 0], position[m, 1], position[m, 2],
            rotation[m, 0], rotation[m, 1], rotation[m, 2], rotation[m, 3], taken, feature, normal, depth, point,
        )  # fmt: skip
