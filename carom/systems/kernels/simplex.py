"""The point of a simplex of at most four corners that is nearest to the origin."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import cross

EVEN_LEAST = 1e-300  # squared length below which a side is no side


@inlined
def weights_on_segment(ax, ay, az, bx, by, bz):
    """Return the weights of a and b in the nearest point of their segment (Ericson 5.1.2)."""
    ux, uy, uz = bx - ax, by - ay, bz - az
    along, length = -(ax * ux + ay * uy + az * uz), ux * ux + uy * uy + uz * uz
    if along <= 0.0 or length <= EVEN_LEAST:
        return 1.0, 0.0
    if along >= length:
        return 0.0, 1.0
    t = along / length
    return 1.0 - t, t


@inlined
def weights_on_triangle(ax, ay, az, bx, by, bz, cx, cy, cz):
    """Return the weights of a, b and c in the nearest point of their triangle, by Voronoi regions (Ericson 5.1.5).

    The regions' areas are expanded about a, since the plain products cancel for triangles far from the origin.
    """
    ux, uy, uz, vx, vy, vz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
    uu, uv, vv = ux * ux + uy * uy + uz * uz, ux * vx + uy * vy + uz * vz, vx * vx + vy * vy + vz * vz
    du, dv = -(ax * ux + ay * uy + az * uz), -(ax * vx + ay * vy + az * vz)
    if du <= 0.0 and dv <= 0.0:
        return 1.0, 0.0, 0.0
    if du >= uu and dv - uv <= du - uu:
        return 0.0, 1.0, 0.0
    if dv >= vv and du - uv <= dv - vv:
        return 0.0, 0.0, 1.0
    of_c, of_b = uu * dv - uv * du, vv * du - uv * dv
    nx, ny, nz = cross(ux, uy, uz, vx, vy, vz)
    whole = nx * nx + ny * ny + nz * nz
    of_a = whole - of_b - of_c
    if of_c <= 0.0 and 0.0 <= du <= uu:
        t = du / uu
        return 1.0 - t, t, 0.0
    if of_b <= 0.0 and 0.0 <= dv <= vv:
        t = dv / vv
        return 1.0 - t, 0.0, t
    from_b, to_b = (dv - uv) - (du - uu), (du - uv) - (dv - vv)
    if of_a <= 0.0 and from_b >= 0.0 and to_b >= 0.0 and from_b + to_b > 0.0:
        t = from_b / (from_b + to_b)
        return 0.0, 1.0 - t, t
    if whole <= EVEN_LEAST:
        return 1.0, 0.0, 0.0
    return 1.0 - (of_b + of_c) / whole, of_b / whole, of_c / whole


@inlined
def nearest_on_simplex(corner, name, weight, count):
    """Reduce a simplex to the corners that carry its nearest point and write their weights; return how many stay.

    ``corner`` holds three numbers each, ``name`` two. Four that stay enclose the origin.
    """
    if count == 1:
        weight[0] = 1.0
        return 1
    weight[2] = weight[3] = 0.0
    if count == 2:
        weight[0], weight[1] = weights_on_segment(corner[0], corner[1], corner[2], corner[3], corner[4], corner[5])
    elif count == 3:
        weight[0], weight[1], weight[2] = weights_on_triangle(
            corner[0], corner[1], corner[2], corner[3], corner[4], corner[5], corner[6], corner[7], corner[8]
        )
    else:
        least, outside = 0.0, False
        for face in range(4):
            i, j, k = 3 * ((face + 1) % 4), 3 * ((face + 2) % 4), 3 * ((face + 3) % 4)
            ax, ay, az = corner[i], corner[i + 1], corner[i + 2]
            bx, by, bz, cx, cy, cz = corner[j], corner[j + 1], corner[j + 2], corner[k], corner[k + 1], corner[k + 2]
            nx, ny, nz = cross(bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az)
            dx, dy, dz = corner[3 * face] - ax, corner[3 * face + 1] - ay, corner[3 * face + 2] - az
            here, there = -(nx * ax + ny * ay + nz * az), nx * dx + ny * dy + nz * dz
            if here * there > 0.0:
                continue
            p, q, r = weights_on_triangle(ax, ay, az, bx, by, bz, cx, cy, cz)
            x, y, z = p * ax + q * bx + r * cx, p * ay + q * by + r * cy, p * az + q * bz + r * cz
            squared = x * x + y * y + z * z
            if not outside or squared < least:
                least, outside = squared, True
                weight[face], weight[(face + 1) % 4] = 0.0, p
                weight[(face + 2) % 4], weight[(face + 3) % 4] = q, r
        if not outside:
            return 4
    kept = 0
    for k in range(count):
        if weight[k] > 0.0:
            weight[kept] = weight[k]
            name[2 * kept], name[2 * kept + 1] = name[2 * k], name[2 * k + 1]
            for d in range(3):
                corner[3 * kept + d] = corner[3 * k + d]
            kept += 1
    return kept
