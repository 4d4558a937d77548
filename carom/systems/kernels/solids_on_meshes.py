"""Narrow phase of capsules, boxes and hulls against meshes."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import FLAT_COSINE, SAME_PLACE
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.hulls_narrow import most_of
from carom.systems.kernels.mesh_areas import MOST_CORNERS, points_over_face, points_over_triangle
from carom.systems.kernels.mesh_axes import ASIDE, FAR, ON_FACE, ON_POINT, ON_TRIANGLE, most_apart_from_triangle
from carom.systems.kernels.mesh_boxes import BOX_ROOM, most_apart_from_box, place_box
from carom.systems.kernels.mesh_corners import solid_over_triangle
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
from carom.systems.kernels.polyhedra import BOX, SEGMENT, face_towards, place_faces, place_vertices, polyhedron_of
from carom.systems.kernels.spatial import product, turn


@shared("start", "count", "feature", "normal", "depth", "point", makes_arrays=True)
def measure_solids_on_meshes(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of a capsule, box or hull and a mesh, in the form of `measure_balls`.

    Triangle by triangle, then made into manifolds. Those that face away from the solid's middle are only touched at
    their edges and corners. A solid whose middle is behind the triangle nearest to it, but not farther than its own
    corners are from it, is pushed out to the front, as if that triangle had no end.
    """
    triangles, links, vertices, fan_start, fan = (
        meshes.triangles, meshes.links, meshes.vertices, meshes.fan_start, meshes.fan,
    )  # fmt: skip
    root, bounds, nodes = meshes.root, meshes.bounds, meshes.nodes  # taken out once: each time counts references
    loop_start, loop_vertex, edges = hulls.loop_start, hulls.loop_vertex, hulls.edges
    corners, faces_most = most_of(hulls.vertex_start), most_of(hulls.face_start)
    most = 2 * most_of(hulls.loop_start) + 8
    v, planes = np.empty(3 * corners), np.empty(4 * faces_most)
    height, lean = np.empty(corners), np.empty(faces_most)
    polygon, tag = np.empty(6 * most), np.empty(4 * most, np.int64)
    own, ends = np.empty(BOX_ROOM), np.array([0, 1])
    found = np.empty(FEW, np.uint32)
    points, names, kept = np.empty(WIDTH * FEW), np.empty(FEW, np.int64), np.empty(MOST_MESH_POINTS, np.int64)
    place, gaps, alike = np.empty(3 * FEW), np.empty(FEW), np.empty(FEW, np.int64)
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for index in range(begin, end):
        pair, b, m = which[index], first[index], second[index]
        start[pair] = taken
        qx, qy, qz, qw = rotation[m, 0], rotation[m, 1], rotation[m, 2], rotation[m, 3]
        ox, oy, oz = position[m, 0], position[m, 1], position[m, 2]
        x, y, z = turn(-qx, -qy, -qz, qw, position[b, 0] - ox, position[b, 1] - oy, position[b, 2] - oz)
        tx, ty, tz, tw = product(-qx, -qy, -qz, qw, rotation[b, 0], rotation[b, 1], rotation[b, 2], rotation[b, 3])
        p, sx, sy, sz, radius = polyhedron_of(
            shape[b], size[b, 0], size[b, 1], size[b, 2], geometry[b], hulls.polyhedron
        )
        end = place_vertices(hulls, p, sx, sy, sz, x, y, z, tx, ty, tz, tw, v, 0)
        faces = place_faces(hulls, p, sx, sy, sz, x, y, z, tx, ty, tz, tw, planes, 0)
        if p == BOX:
            place_box(own, sx, sy, sz, x, y, z, tx, ty, tz, tw)
        reach = reaches[pair]
        far = radius + reach
        farthest, lx, ly, lz, hx, hy, hz = 0.0, 1e300, 1e300, 1e300, -1e300, -1e300, -1e300
        for i in range(end):
            lx, ly, lz = min(lx, v[3 * i]), min(ly, v[3 * i + 1]), min(lz, v[3 * i + 2])
            hx, hy, hz = max(hx, v[3 * i]), max(hy, v[3 * i + 1]), max(hz, v[3 * i + 2])
            dx, dy, dz = v[3 * i] - x, v[3 * i + 1] - y, v[3 * i + 2] - z
            farthest = max(farthest, dx * dx + dy * dy + dz * dz)
        width = 0.5 * sqrt((hx - lx) * (hx - lx) + (hy - ly) * (hy - ly) + (hz - lz) * (hz - lz)) + radius
        near, found = all_triangles(
            root[geometry[m]], bounds, nodes, triangles,
            lx - far, ly - far, lz - far, hx + far, hy + far, hz + far, found,
        )  # fmt: skip
        behind = behind_of(triangles, links, found, near, x, y, z, sqrt(farthest) + far)
        touching = 0
        if behind >= 0:
            a = TRIANGLE * behind
            nx, ny, nz = triangles[a + 9], triangles[a + 10], triangles[a + 11]
            level = nx * triangles[a] + ny * triangles[a + 1] + nz * triangles[a + 2]
            while end > len(names):
                names, points = grown(names), grown(points)
            for i in range(end):
                gap = nx * v[3 * i] + ny * v[3 * i + 1] + nz * v[3 * i + 2] - level
                if gap <= far:
                    half = 0.5 * (gap + radius)
                    touching = add_point(
                        points, names, touching, nx, ny, nz,
                        v[3 * i] - half * nx, v[3 * i + 1] - half * ny, v[3 * i + 2] - half * nz, gap - radius, i,
                    )  # fmt: skip
            near = 0
        edges_begin, edges_end = hulls.edge_start[p], hulls.edge_start[p + 1]
        for c in range(near):
            t = found[c]
            a = TRIANGLE * t
            nx, ny, nz = triangles[a + 9], triangles[a + 10], triangles[a + 11]
            dx, dy, dz = x - triangles[a], y - triangles[a + 1], z - triangles[a + 2]
            hidden = nx * dx + ny * dy + nz * dz < 0.0
            if p == BOX:
                kind, gap, nx, ny, nz, face, px, py, pz = most_apart_from_box(
                    own, triangles, links, vertices, fan_start, fan, t, far
                )
            else:
                kind, gap, nx, ny, nz, face, px, py, pz = most_apart_from_triangle(
                    v, end, planes, faces, edges, edges_begin, edges_end,
                    triangles, links, vertices, fan_start, fan, t, far, height, lean,
                )  # fmt: skip
            if kind == FAR or gap > far or (hidden and (kind in (ON_TRIANGLE, ASIDE) or gap < -SAME_PLACE * width)):
                continue
            while touching + most + end > len(names):
                names, points = grown(names), grown(points)
            before = touching
            if kind == ON_POINT:
                level, cosine = face_towards(hulls, p, v, 0, end, planes, 0, -nx, -ny, -nz)
                facing = nx * triangles[a + 9] + ny * triangles[a + 10] + nz * triangles[a + 11]
                f = hulls.face_start[p] + level
                # Where edges cross all but level with an area, all of that is as near, and not one end or the other.
                if level >= 0 and facing >= max(cosine, FLAT_COSINE):
                    touching = solid_over_triangle(
                        v, end, loop_vertex, loop_start[f], loop_start[f + 1], triangles, links, vertices,
                        t, radius, reach, found, near, polygon, tag, most, points, names, touching,
                    )  # fmt: skip
                elif cosine >= FLAT_COSINE:
                    touching = points_over_face(
                        v, loop_vertex, loop_start[f], loop_start[f + 1],
                        planes[4 * level], planes[4 * level + 1], planes[4 * level + 2], planes[4 * level + 3],
                        triangles, links, t, gap, reach, polygon, tag, most, points, names, touching,
                    )  # fmt: skip
                as_deep_as(points, before, touching, nx, ny, nz, gap)
                if touching == before:
                    half = 0.5 * (gap + radius)
                    touching = add_point(
                        points, names, touching, nx, ny, nz, px - half * nx, py - half * ny, pz - half * nz,
                        gap - radius, MOST_CORNERS + 16 * MOST_CORNERS * links[8 * t + 7],
                    )  # fmt: skip
            elif kind == ON_FACE:
                f = hulls.face_start[p] + face
                touching = points_over_face(
                    v, loop_vertex, loop_start[f], loop_start[f + 1], -nx, -ny, -nz,
                    planes[4 * face + 3], triangles, links, t, gap, reach,
                    polygon, tag, most, points, names, touching,
                )  # fmt: skip
            elif p == SEGMENT:
                touching = points_over_triangle(
                    v, ends, 0, 2, triangles, links, vertices, t, radius, reach, found, near,
                    polygon, tag, most, points, names, touching,
                )  # fmt: skip
            else:
                if face < 0:
                    face, _ = face_towards(hulls, p, v, 0, end, planes, 0, -nx, -ny, -nz)
                f = hulls.face_start[p] + face
                touching = solid_over_triangle(
                    v, end, loop_vertex, loop_start[f], loop_start[f + 1], triangles, links, vertices,
                    t, radius, reach, found, near, polygon, tag, most, points, names, touching,
                )  # fmt: skip
            if kind == ASIDE:  # what is beneath the triangle's plane, yet in front of the mesh, is beyond a thin part
                for k in range(touching - 1, before - 1, -1):
                    i = WIDTH * k
                    back = 0.5 * (points[i + 6] + 2.0 * radius)
                    if back - 0.5 * radius < 0.0 and behind_of(
                        triangles, links, found, near,
                        points[i + 3] + back * nx, points[i + 4] + back * ny, points[i + 5] + back * nz, 1e300,
                    ) < 0:  # fmt: skip
                        touching -= 1
                        names[k] = names[touching]
                        for d in range(WIDTH):
                            points[i + d] = points[WIDTH * touching + d]
        while touching > len(alike):
            place, gaps, alike = grown(place), grown(gaps), grown(alike)
        chosen = choose_points(
            points, names, touching, SAME_PLACE * width, reach if p >= BOX else 0.0, kept, place, gaps, alike
        )
        count[pair] = chosen
        taken = write_chosen(
            points, names, kept, chosen, ox, oy, oz, qx, qy, qz, qw, taken, feature, normal, depth, point
        )
