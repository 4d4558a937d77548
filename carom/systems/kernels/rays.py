"""Rays cast at colliders, and which way what they meet faces."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import ON_SURFACE
from carom.systems.kernels.cores import CONVEX_SHAPE
from carom.systems.kernels.eights import FIRST_BLOCK, LOWEST, MOST_WAITING, look_into, push_seen
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.lanes import WIDTH, address
from carom.systems.kernels.mesh_tree import TRIANGLE
from carom.systems.kernels.ray_colliders import (
    FIELD_SHAPE,
    MESH_SHAPE,
    WITHIN,
    facing,
    meet_mesh,
    seen_from,
    through_hull,
    through_solid,
    where_met,
)
from carom.systems.kernels.ray_meshes import one_over
from carom.systems.kernels.ray_solids import FAR
from carom.systems.kernels.spatial import turn

FIRST, ANY, ALL = 0, 1, 2


@kernel("ray", "row", "distance", "part", makes_arrays=True)
def cast(
    wanted, origin, direction, reach, takes, endless, members, tree, shape, size, geometry, position, rotation,
    hulls, meshes, mesh_tree, ray, row, distance, part,
):  # fmt: skip
    """Write what rays meet, FIRST, ANY or ALL of it; return how many hits there are, or -1 where they do not fit in.

    Colliders are ``members``, in the order of a tree of eights, and those of ``endless`` bounds; only those count that
    ``takes`` says. Directions are unit vectors. Of several colliders at one distance the lowest row is the first. A
    part is the face, of meshes the triangle in the order of its tree, or WITHIN.
    """
    root, bounds, polyhedron, face_start = meshes.root, meshes.bounds, hulls.polyhedron, hulls.face_start
    normals, offsets = hulls.normals, hulls.offsets
    mesh_root, mesh_inside, mesh_blocks = mesh_tree.root, mesh_tree.inside, mesh_tree.blocks
    boxes, leaves = address(tree.boxes), address(tree.leaves)
    mesh_boxes, corners = address(mesh_tree.boxes), address(mesh_tree.leaves)
    inside, blocks = tree.inside, tree.blocks
    stack, ahead = np.empty(MOST_WAITING, np.int64), np.empty(MOST_WAITING)
    mesh_stack, mesh_ahead = np.empty(MOST_WAITING, np.int64), np.empty(MOST_WAITING)
    seen, mesh_seen = np.empty((2, WIDTH)), np.empty((2, WIDTH))
    lanes, mesh_lanes = address(seen), address(mesh_seen)
    near = np.empty(max(WIDTH, len(endless)), np.int64)
    hits = 0
    for r in range(len(origin)):
        ox, oy, oz = origin[r, 0], origin[r, 1], origin[r, 2]
        dx, dy, dz = direction[r, 0], direction[r, 1], direction[r, 2]
        ix, iy, iz = one_over(dx), one_over(dy), one_over(dz)
        limit, begun, waiting = reach[r], hits, min(len(members), 1)
        stack[0], ahead[0] = 0, 0.0
        count = len(endless)
        for m in range(count):
            near[m] = endless[m]
        while True:
            for m in range(count):
                i = near[m]
                if not takes[i]:
                    continue
                start, x, y, z, ux, uy, uz = seen_from(
                    ox, oy, oz, dx, dy, dz, position[i, 0], position[i, 1], position[i, 2],
                    rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3],
                )  # fmt: skip
                if shape[i] in (MESH_SHAPE, FIELD_SHAPE):
                    g = geometry[i]
                    s, f = meet_mesh(
                        shape[i] == FIELD_SHAPE, mesh_root[g], bounds, 6 * root[g],
                        mesh_boxes, mesh_inside, mesh_blocks, corners,
                        x, y, z, ux, uy, uz, start, start + limit, mesh_stack, mesh_ahead, mesh_seen, mesh_lanes,
                    )  # fmt: skip
                else:
                    if shape[i] == CONVEX_SHAPE:
                        p = polyhedron[geometry[i]]
                        enter, leave, f = through_hull(
                            normals, offsets, face_start[p], face_start[p + 1], x, y, z, ux, uy, uz
                        )
                    else:
                        enter, leave, f = through_solid(
                            shape[i], size[i, 0], size[i, 1], size[i, 2], size[i, 3], x, y, z, ux, uy, uz
                        )
                    s, f = where_met(enter, leave, f, start, start + limit)
                way = max(s - start, 0.0)
                if not s < FAR or way > limit:
                    continue
                if wanted != ALL:
                    if hits > begun and way == limit and i > row[begun]:
                        continue
                    hits, limit = begun, way
                if hits == len(ray):
                    return -1
                ray[hits], row[hits], distance[hits], part[hits] = r, i, way, f
                hits += 1
            count = 0
            while waiting > 0 and count == 0 and not (wanted == ANY and hits > begun):
                waiting -= 1
                at = stack[waiting]
                if ahead[waiting] > limit + ON_SURFACE:
                    continue
                if at >= 0:
                    bits = look_into(boxes, 6 * at, ox, oy, oz, ix, iy, iz, 0.0, limit, lanes)
                    waiting = push_seen(inside, at, bits, seen, stack, ahead, waiting)
                    continue
                block = FIRST_BLOCK - at
                bits = look_into(leaves, 6 * block, ox, oy, oz, ix, iy, iz, 0.0, limit, lanes)
                bits &= (1 << blocks[block, 1]) - 1
                while bits > 0:
                    near[count] = members[blocks[block, 0] + LOWEST[bits]]
                    bits &= bits - 1
                    count += 1
            if count == 0:
                break
    return hits


@kernel("normal", "part")
def face_hits(
    origin, direction, ray, row, distance, shape, size, geometry, position, rotation, hulls, meshes, part, normal
):  # fmt: skip
    """Write the outward unit normal of each hit that `cast` found, and of meshes their own number of the triangle."""
    normals, face_start, polyhedron = hulls.normals, hulls.face_start, hulls.polyhedron
    triangles, links = meshes.triangles, meshes.links
    for h in range(len(ray)):
        r, i, f = ray[h], row[h], part[h]
        dx, dy, dz = direction[r, 0], direction[r, 1], direction[r, 2]
        if f == WITHIN:
            normal[h, 0], normal[h, 1], normal[h, 2] = -dx, -dy, -dz
            continue
        qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
        if shape[i] in (MESH_SHAPE, FIELD_SHAPE):
            t = TRIANGLE * f
            nx, ny, nz = triangles[t + 9], triangles[t + 10], triangles[t + 11]
            part[h] = links[8 * f + 7]
        elif shape[i] == CONVEX_SHAPE:
            k = face_start[polyhedron[geometry[i]]] + f
            nx, ny, nz = normals[k, 0], normals[k, 1], normals[k, 2]
        else:
            start, x, y, z, ux, uy, uz = seen_from(
                origin[r, 0], origin[r, 1], origin[r, 2], dx, dy, dz,
                position[i, 0], position[i, 1], position[i, 2], qx, qy, qz, qw,
            )  # fmt: skip
            s = start + distance[h]
            nx, ny, nz = facing(shape[i], size[i, 0], size[i, 1], size[i, 2], f, x + s * ux, y + s * uy, z + s * uz)
        normal[h, 0], normal[h, 1], normal[h, 2] = turn(qx, qy, qz, qw, nx, ny, nz)
