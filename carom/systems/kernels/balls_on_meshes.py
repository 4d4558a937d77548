"""Narrow phase of balls and points against meshes."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import LEAST_PART, SAME_PLACE
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.mesh_points import (
    MOST_MESH_POINTS,
    WIDTH,
    add_point,
    choose_points,
    write_chosen,
)
from carom.systems.kernels.mesh_surface import FACE, behind_of, falls_away, nearest_on_triangle, on_rim
from carom.systems.kernels.mesh_tree import FEW, TRIANGLE, all_triangles, grown
from carom.systems.kernels.spatial import turn


@shared("start", "count", "feature", "normal", "depth", "point", makes_arrays=True)
def measure_balls_on_meshes(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of a ball or point and a mesh, in the form of `measure_balls`.

    There is a point wherever the distance to the mesh is least among the places around: on a face, or on an edge or
    corner that the mesh falls away from. The nearest of them says on which side the ball's centre is, by the triangle
    there that faces it most. Behind, which only a ball driven in beyond its middle is, it is pushed out to the front by
    way of that place alone.
    """
    triangles, links, vertices, fan_start, fan = (
        meshes.triangles, meshes.links, meshes.vertices, meshes.fan_start, meshes.fan,
    )  # fmt: skip
    root, bounds, nodes = meshes.root, meshes.bounds, meshes.nodes  # taken out once: each time counts references
    found = np.empty(FEW, np.uint32)
    points, names, kept = np.empty(WIDTH * FEW), np.empty(FEW, np.int64), np.empty(MOST_MESH_POINTS, np.int64)
    place, gaps, alike = np.empty(3 * FEW), np.empty(FEW), np.empty(FEW, np.int64)
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for k in range(begin, end):
        p, i, m = which[k], first[k], second[k]
        start[p] = taken
        qx, qy, qz, qw = rotation[m, 0], rotation[m, 1], rotation[m, 2], rotation[m, 3]
        px, py, pz = position[m, 0], position[m, 1], position[m, 2]
        x, y, z = turn(-qx, -qy, -qz, qw, position[i, 0] - px, position[i, 1] - py, position[i, 2] - pz)
        radius = size[i, 0]
        far = radius + reaches[p]
        near, found = all_triangles(
            root[geometry[m]], bounds, nodes, triangles,
            x - far, y - far, z - far, x + far, y + far, z + far, found,
        )  # fmt: skip
        while near > len(names):
            names, points = grown(names), grown(points)
        touching = 0
        behind = behind_of(triangles, links, found, near, x, y, z, far)
        if behind >= 0:
            cx, cy, cz, _ = nearest_on_triangle(triangles, behind, x, y, z)
            dx, dy, dz = cx - x, cy - y, cz - z
            distance, near = sqrt(dx * dx + dy * dy + dz * dz), 0
            a = TRIANGLE * behind
            nx, ny, nz = triangles[a + 9], triangles[a + 10], triangles[a + 11]
            if distance > LEAST_PART:
                nx, ny, nz = dx / distance, dy / distance, dz / distance
            half = -0.5 * (distance + radius)
            touching = add_point(
                points, names, 0, nx, ny, nz, cx + half * nx, cy + half * ny, cz + half * nz, 2.0 * half, 0
            )
        for c in range(near):
            t = found[c]
            a = TRIANGLE * t
            nx, ny, nz = triangles[a + 9], triangles[a + 10], triangles[a + 11]
            if abs(nx * (x - triangles[a]) + ny * (y - triangles[a + 1]) + nz * (z - triangles[a + 2])) > far:
                continue
            cx, cy, cz, part = nearest_on_triangle(triangles, t, x, y, z)
            dx, dy, dz = x - cx, y - cy, z - cz
            distance = sqrt(dx * dx + dy * dy + dz * dz)
            if distance > far:
                continue
            above = distance if on_rim(links, t, part) else nx * dx + ny * dy + nz * dz
            if above < 0.0 or not falls_away(links, vertices, fan_start, fan, t, part, dx, dy, dz):
                continue
            if part != FACE and distance > LEAST_PART:
                nx, ny, nz = dx / distance, dy / distance, dz / distance
            half = 0.5 * (distance - radius)
            touching = add_point(
                points, names, touching, nx, ny, nz, cx + half * nx, cy + half * ny, cz + half * nz, 2.0 * half, 0
            )
        while touching > len(alike):
            place, gaps, alike = grown(place), grown(gaps), grown(alike)
        chosen = choose_points(points, names, touching, SAME_PLACE * radius + LEAST_PART, 0.0, kept, place, gaps, alike)
        count[p] = chosen
        taken = write_chosen(
            points, names, kept, chosen, px, py, pz, qx, qy, qz, qw, taken, feature, normal, depth, point
        )
