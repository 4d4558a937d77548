"""Along which axis a solid and a triangle of a mesh are parted most, among those the mesh is outermost along."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, BORDER, OVER_EDGE, PARALLEL_EDGES
from carom.systems.kernels.distance import outermost
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.mesh_surface import CORNER, EDGE, falls_away, is_tip, leads
from carom.systems.kernels.mesh_tree import TRIANGLE
from carom.systems.kernels.spatial import cross

FAR, ON_TRIANGLE, ON_FACE, ON_POINT, ASIDE = 0, 1, 2, 3, 4


@woven
def most_apart_from_triangle(
    v, end, planes, faces, edges, edges_begin, edges_end,
    triangles, links, vertices, fan_start, fan, t, far, height, lean,
):  # fmt: skip
    """Return (kind, gap, unit normal from the mesh, face, point of the solid) where a solid's core meets a triangle.

    Axes are the triangle's normal, the core's faces' and those of pairs of edges (Ericson 5.2.9); of cores apart also
    the shortest way between their edges. All but the first count only where the mesh falls away from them, which
    leaves no ghosts: what is beside a flat or hollow edge is met by the neighbour's normal. FAR: nothing within
    ``far``; ON_FACE: along the normal of the core's ``face``; ON_POINT: at that one point. ASIDE: the core is apart,
    yet partly beneath the triangle's plane, through a neighbour or beyond a thin part. ``height`` and ``lean`` are room
    for a number per corner and per face.
    """
    a = TRIANGLE * t
    nx, ny, nz = triangles[a + 9], triangles[a + 10], triangles[a + 11]
    level, gap = nx * triangles[a] + ny * triangles[a + 1] + nz * triangles[a + 2], 1e300
    for c in range(end):
        height[c] = nx * v[3 * c] + ny * v[3 * c + 1] + nz * v[3 * c + 2] - level
        gap = min(gap, height[c])
    kind, face, px, py, pz = ON_TRIANGLE, -1, 0.0, 0.0, 0.0
    if gap > far:
        return FAR, gap, nx, ny, nz, face, px, py, pz
    active, over = links[8 * t + 6], True
    for k in range(3):  # planes square to the triangle through its edges
        i, j = a + 3 * k, a + 3 * ((k + 1) % 3)
        x, y, z = cross(
            triangles[j] - triangles[i], triangles[j + 1] - triangles[i + 1], triangles[j + 2] - triangles[i + 2],
            nx, ny, nz,
        )  # fmt: skip
        least, most = 1e300, -1e300
        for c in range(0, 3 * end, 3):
            along = x * v[c] + y * v[c + 1] + z * v[c + 2]
            least, most = min(least, along), max(most, along)
        offset, scale = x * triangles[i] + y * triangles[i + 1] + z * triangles[i + 2], triangles[a + 12 + k]
        least, most = (least - offset) * scale, (most - offset) * scale
        if least > far:
            return FAR, least, nx, ny, nz, face, px, py, pz
        over = over and least <= OVER_EDGE
        if most < min(gap, 0.0):
            active &= ~(1 << k)  # all of the core is on this side of the edge, so that it meets something nearer
    most, border = gap, -1e300
    for f in range(faces):
        x, y, z = planes[4 * f], planes[4 * f + 1], planes[4 * f + 2]
        corner, back = 0, 1e300
        for c in range(3):
            b = a + 3 * c
            along = x * triangles[b] + y * triangles[b + 1] + z * triangles[b + 2]
            if along < back:
                corner, back = c, along
        back -= planes[4 * f + 3]
        if back > far:
            return FAR, back, nx, ny, nz, face, px, py, pz
        most = max(most, back)
        if back <= gap + BIAS:
            continue
        if is_tip(links, vertices, fan_start, fan, t, corner, -x, -y, -z):
            kind, gap, face, nx, ny, nz = ON_FACE, back, f, -x, -y, -z
        elif active & (1 << corner | 1 << (corner + 2) % 3):
            border = max(border, back)
    if active == 0:
        return settled(kind, over, gap, most, border), gap, nx, ny, nz, face, px, py, pz
    for k in range(3):
        if active & (1 << k) == 0:
            continue
        i, j, o = a + 3 * k, a + 3 * ((k + 1) % 3), a + 3 * ((k + 2) % 3)
        bx, by, bz = triangles[i], triangles[i + 1], triangles[i + 2]
        ux, uy, uz = triangles[j] - bx, triangles[j + 1] - by, triangles[j + 2] - bz
        ox, oy, oz = triangles[o] - bx, triangles[o + 1] - by, triangles[o + 2] - bz
        length = ux * ux + uy * uy + uz * uz
        for f in range(faces):
            lean[f] = planes[4 * f] * ux + planes[4 * f + 1] * uy + planes[4 * f + 2] * uz
        for e in range(edges_begin, edges_end):
            s, d, f, g = edges[e, 0], edges[e, 1], edges[e, 2], edges[e, 3]
            if min(height[s], height[d]) > far or (f >= 0 and lean[f] * lean[g] >= 0.0):
                continue
            s, d, f, g = 3 * s, 3 * d, 4 * f, 4 * g
            wx, wy, wz = v[d] - v[s], v[d + 1] - v[s + 1], v[d + 2] - v[s + 2]
            x, y, z = cross(ux, uy, uz, wx, wy, wz)
            squared = x * x + y * y + z * z
            if squared <= PARALLEL_EDGES * length * (wx * wx + wy * wy + wz * wz):
                continue
            scale = 1.0 / sqrt(squared)
            if x * ox + y * oy + z * oz > 0.0:
                scale = -scale
            x, y, z = x * scale, y * scale, z * scale
            dx, dy, dz = v[s] - bx, v[s + 1] - by, v[s + 2] - bz
            apart = x * dx + y * dy + z * dz
            if apart <= gap + BIAS:
                continue
            if f >= 0 and (
                x * (planes[f] + planes[g]) + y * (planes[f + 1] + planes[g + 1]) + z * (planes[f + 2] + planes[g + 2])
                > 0.0
            ):
                continue
            most = max(most, apart)
            if x * triangles[a + 9] + y * triangles[a + 10] + z * triangles[a + 11] < 0.0:
                border = max(border, apart)
            cx, cy, cz = cross(dx, dy, dz, ux, uy, uz)  # how far along both the edges cross, seen along the normal
            across = (x * cx + y * cy + z * cz) * scale
            cx, cy, cz = cross(dx, dy, dz, wx, wy, wz)
            along = (x * cx + y * cy + z * cz) * scale
            if across < 0.0 or across > 1.0 or along < 0.0 or along > 1.0:
                continue
            if not falls_away(links, vertices, fan_start, fan, t, EDGE + k, x, y, z):
                border = max(border, apart)
                continue
            kind, gap, nx, ny, nz = ON_POINT, apart, x, y, z
            px, py, pz = v[s] + across * wx, v[s + 1] + across * wy, v[s + 2] + across * wz
    if most <= 0.0 or gap > far:
        return settled(kind, over, gap, most, border), gap, nx, ny, nz, face, px, py, pz
    shortest, sx, sy, sz, qx, qy, qz, part = 1e300, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0
    for k in range(3):
        if active & (1 << k) == 0:
            continue
        i, j = a + 3 * k, a + 3 * ((k + 1) % 3)
        for e in range(edges_begin, edges_end):
            s, d = edges[e, 0], edges[e, 1]
            low = min(height[s], height[d])
            if low > far or (low > 0.0 and low * low > shortest):
                continue
            s, d = 3 * s, 3 * d
            along, across = nearest_on_edges(
                triangles[i], triangles[i + 1], triangles[i + 2], triangles[j], triangles[j + 1], triangles[j + 2],
                v[s], v[s + 1], v[s + 2], v[d], v[d + 1], v[d + 2],
            )  # fmt: skip
            cx, cy = v[s] + across * (v[d] - v[s]), v[s + 1] + across * (v[d + 1] - v[s + 1])
            cz = v[s + 2] + across * (v[d + 2] - v[s + 2])
            x = cx - triangles[i] - along * (triangles[j] - triangles[i])
            y = cy - triangles[i + 1] - along * (triangles[j + 1] - triangles[i + 1])
            z = cz - triangles[i + 2] - along * (triangles[j + 2] - triangles[i + 2])
            squared = x * x + y * y + z * z
            if squared < shortest:
                shortest, sx, sy, sz, qx, qy, qz = squared, x, y, z, cx, cy, cz
                part = EDGE + k
                if along == 0.0:
                    part = CORNER + k
                elif along == 1.0:
                    part = CORNER + (k + 1) % 3
    distance = sqrt(shortest)
    if shortest > max(gap, 0.0) * max(gap, 0.0) + OVER_EDGE * OVER_EDGE:  # beside what the gap is measured over
        x, y, z = sx / distance, sy / distance, sz / distance
        _, low = outermost(v, 0, end, -x, -y, -z)
        outer = -low >= x * qx + y * qy + z * qz - BIAS
        if part < CORNER:
            outer = outer and not leads(vertices, 3 * links[8 * t + part], 3 * links[8 * t + (part + 2) % 3], x, y, z)
        if outer and falls_away(links, vertices, fan_start, fan, t, part, x, y, z):
            return ON_POINT if distance <= far else FAR, distance, x, y, z, face, qx, qy, qz
    return settled(kind, over, gap, most, border), gap, nx, ny, nz, face, px, py, pz


@inlined
def settled(kind, over, gap, most, border):
    """Return the kind of what is known but for this: is the core over the triangle, and apart after all.

    What overlaps a triangle by less than BORDER of its depth along ``border``, the best of the axes beyond convex edges
    that the mesh is not outermost along, meets what is beyond there instead.
    """
    if kind == ON_TRIANGLE:
        if not over or (gap < 0.0 and BORDER * (gap + BIAS) < border):
            return FAR
        return ASIDE if most > BIAS and gap < 0.0 else kind
    return FAR if most > BIAS and gap < 0.0 else kind


@inlined
def nearest_on_edges(ax, ay, az, bx, by, bz, cx, cy, cz, dx, dy, dz):
    """Return how far along a to b and along c to d (0 to 1) two segments are nearest to each other (Ericson 5.1.9)."""
    ux, uy, uz, wx, wy, wz = bx - ax, by - ay, bz - az, dx - cx, dy - cy, dz - cz
    rx, ry, rz = ax - cx, ay - cy, az - cz
    uu, ww, uw = ux * ux + uy * uy + uz * uz, wx * wx + wy * wy + wz * wz, ux * wx + uy * wy + uz * wz
    ur, wr = ux * rx + uy * ry + uz * rz, wx * rx + wy * ry + wz * rz
    determinant = uu * ww - uw * uw
    along = 0.0
    if determinant > PARALLEL_EDGES * uu * ww:
        along = min(max((uw * wr - ur * ww) / determinant, 0.0), 1.0)
    across = (uw * along + wr) / ww
    if across < 0.0:
        across, along = 0.0, min(max(-ur / uu, 0.0), 1.0)
    elif across > 1.0:
        across, along = 1.0, min(max((uw - ur) / uu, 0.0), 1.0)
    return along, across
