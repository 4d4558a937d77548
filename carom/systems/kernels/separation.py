"""How deep two polyhedra overlap, and along which normal: the separating axis test."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, PARALLEL_EDGES
from carom.systems.kernels.distance import outermost
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import cross


@inlined
def most_apart(v, planes, middle, end, faces, all_faces, edges, a_edges, a_edges_end, b_edges, b_edges_end, near):
    """Return (gap, unit normal, point of the first) along the axis that parts two polyhedra most; a gap < 0 overlaps.

    Axes are the faces' normals and, where it is less deep by BIAS, the normals of pairs of edges that are on the
    surface of the Minkowski difference, which their arcs on the Gauss map tell (Gregorius, The Separating Axis Test,
    GDC 2013). The first may be a point or a segment. ``planes`` holds four numbers per face: normal, offset.
    """
    gap = -1e300
    nx, ny, nz, px, py, pz = 0.0, 1.0, 0.0, 0.0, 0.0, 0.0
    lowest, highest = middle, 0  # vertices of the second and first that are likely to be deep in the other
    for face in range(all_faces):
        x, y, z, offset = planes[4 * face], planes[4 * face + 1], planes[4 * face + 2], planes[4 * face + 3]
        k, begin, stop = (lowest, middle, end) if face < faces else (highest, 0, middle)
        apart = x * v[3 * k] + y * v[3 * k + 1] + z * v[3 * k + 2] - offset
        for i in range(begin, stop):
            if apart <= gap:  # this vertex is as deep already as all are along the best axis
                break
            here = x * v[3 * i] + y * v[3 * i + 1] + z * v[3 * i + 2] - offset
            if here < apart:
                k, apart = i, here
        if face < faces:
            lowest = k
        else:
            highest = k
        if apart <= gap:
            continue
        gap = apart
        if face < faces:
            nx, ny, nz = x, y, z
            px, py, pz = v[3 * k] - x * apart, v[3 * k + 1] - y * apart, v[3 * k + 2] - z * apart
        else:
            nx, ny, nz = -x, -y, -z
            px, py, pz = v[3 * k], v[3 * k + 1], v[3 * k + 2]
    slack = -gap if gap < 0.0 else 1e300
    _, front = outermost(v, 0, middle, nx, ny, nz)
    _, rear = outermost(v, middle, end, -nx, -ny, -nz)
    count = 0  # a pair of edges less deep than the faces lies within that depth of the overlap along n
    for e in range(b_edges, b_edges_end):
        i, j = 3 * (middle + edges[e, 0]), 3 * (middle + edges[e, 1])
        least = min(nx * v[i] + ny * v[i + 1] + nz * v[i + 2], nx * v[j] + ny * v[j + 1] + nz * v[j + 2])
        if least <= front + slack:
            near[count] = e
            count += 1
    fx, fy, fz, least_gap = nx, ny, nz, gap + BIAS
    for e in range(a_edges, a_edges_end):
        i, j = 3 * edges[e, 0], 3 * edges[e, 1]
        ax, ay, az, ux, uy, uz = v[i], v[i + 1], v[i + 2], v[j] - v[i], v[j + 1] - v[i + 1], v[j + 2] - v[i + 2]
        most = fx * ax + fy * ay + fz * az + max(0.0, fx * ux + fy * uy + fz * uz)
        if most < -rear - slack:
            continue
        length = ux * ux + uy * uy + uz * uz
        flat = edges[e, 2] < 0
        lx, ly, lz, rx, ry, rz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        if not flat:
            f, g = 4 * edges[e, 2], 4 * edges[e, 3]
            lx, ly, lz, rx, ry, rz = planes[f], planes[f + 1], planes[f + 2], planes[g], planes[g + 1], planes[g + 2]
        for k in range(count):
            o = near[k]
            f, g = 4 * (faces + edges[o, 2]), 4 * (faces + edges[o, 3])
            mx, my, mz = planes[f], planes[f + 1], planes[f + 2]
            left, right = mx * ux + my * uy + mz * uz, planes[g] * ux + planes[g + 1] * uy + planes[g + 2] * uz
            if left * right >= 0.0:
                continue
            s, t = 3 * (middle + edges[o, 0]), 3 * (middle + edges[o, 1])
            wx, wy, wz = v[t] - v[s], v[t + 1] - v[s + 1], v[t + 2] - v[s + 2]
            if not flat:
                behind, ahead = lx * wx + ly * wy + lz * wz, rx * wx + ry * wy + rz * wz
                if behind * ahead >= 0.0 or left * ahead >= 0.0:
                    continue
            x, y, z = cross(ux, uy, uz, wx, wy, wz)
            squared = x * x + y * y + z * z
            if squared <= PARALLEL_EDGES * length * (wx * wx + wy * wy + wz * wz):
                continue
            ox, oy, oz = cross(wx, wy, wz, mx - planes[g], my - planes[g + 1], mz - planes[g + 2])
            scale = 1.0 / sqrt(squared)
            if x * ox + y * oy + z * oz > 0.0:  # outward of the second is against the normal
                scale = -scale
            x, y, z = x * scale, y * scale, z * scale
            dx, dy, dz = v[s] - ax, v[s + 1] - ay, v[s + 2] - az
            apart = x * dx + y * dy + z * dz
            if apart <= least_gap:
                continue
            gap, least_gap, nx, ny, nz = apart, apart, x, y, z
            cx, cy, cz = cross(dx, dy, dz, wx, wy, wz)
            along = (x * cx + y * cy + z * cz) * scale
            px, py, pz = ax + along * ux, ay + along * uy, az + along * uz
    return gap, nx, ny, nz, px, py, pz
