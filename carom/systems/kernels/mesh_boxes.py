"""Along which axis a box and a triangle of a mesh are parted most: `most_apart_from_triangle` in closed form."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, OVER_EDGE, PARALLEL_EDGES
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.mesh_axes import FAR, ON_FACE, ON_POINT, ON_TRIANGLE, settled
from carom.systems.kernels.mesh_surface import CORNER, EDGE, falls_away, is_tip, leads
from carom.systems.kernels.mesh_tree import TRIANGLE
from carom.systems.kernels.segment_and_box import ALONG, HALF, MIDDLE, beyond, nearest_to_box
from carom.systems.kernels.spatial import cross, turn

FRAME, CORNERS, NORMAL = 12, 24, 33  # of the scratch: middle and axes in the mesh's frame, the triangle in the box's
BOX_ROOM = 36


@woven
def place_box(own, sx, sy, sz, x, y, z, qx, qy, qz, qw):
    """Write half extents, middle and axes of a box for `most_apart_from_box`."""
    own[HALF], own[HALF + 1], own[HALF + 2] = sx, sy, sz
    own[FRAME], own[FRAME + 1], own[FRAME + 2] = x, y, z
    own[FRAME + 3], own[FRAME + 4], own[FRAME + 5] = turn(qx, qy, qz, qw, 1.0, 0.0, 0.0)
    own[FRAME + 6], own[FRAME + 7], own[FRAME + 8] = turn(qx, qy, qz, qw, 0.0, 1.0, 0.0)
    own[FRAME + 9], own[FRAME + 10], own[FRAME + 11] = turn(qx, qy, qz, qw, 0.0, 0.0, 1.0)


@woven
def into_box(own, x, y, z):
    """Return a direction of the mesh's frame in the box's."""
    return (
        own[FRAME + 3] * x + own[FRAME + 4] * y + own[FRAME + 5] * z,
        own[FRAME + 6] * x + own[FRAME + 7] * y + own[FRAME + 8] * z,
        own[FRAME + 9] * x + own[FRAME + 10] * y + own[FRAME + 11] * z,
    )


@woven
def out_of_box(own, x, y, z):
    """Return a direction of the box's frame in the mesh's."""
    return (
        own[FRAME + 3] * x + own[FRAME + 6] * y + own[FRAME + 9] * z,
        own[FRAME + 4] * x + own[FRAME + 7] * y + own[FRAME + 10] * z,
        own[FRAME + 5] * x + own[FRAME + 8] * y + own[FRAME + 11] * z,
    )


@woven
def most_apart_from_box(own, triangles, links, vertices, fan_start, fan, t, far):
    """Return what `most_apart_from_triangle` does; for ON_TRIANGLE the face is that most turned to the triangle.

    Along an axis a box reaches its half extents times the axis' parts from its middle. Of its twelve edges only three
    are outermost along an axis square to an edge of the triangle.
    """
    a, hx, hy, hz = TRIANGLE * t, own[HALF], own[HALF + 1], own[HALF + 2]
    for c in range(3):
        i, j = a + 3 * c, CORNERS + 3 * c
        own[j], own[j + 1], own[j + 2] = into_box(
            own, triangles[i] - own[FRAME], triangles[i + 1] - own[FRAME + 1], triangles[i + 2] - own[FRAME + 2]
        )
    nx, ny, nz = triangles[a + 9], triangles[a + 10], triangles[a + 11]
    face, px, py, pz = -1, 0.0, 0.0, 0.0
    for d in range(3):
        low = min(own[CORNERS + d], own[CORNERS + 3 + d], own[CORNERS + 6 + d])
        high = max(own[CORNERS + d], own[CORNERS + 3 + d], own[CORNERS + 6 + d])
        if max(low, -high) - own[HALF + d] > far:
            return FAR, far, nx, ny, nz, face, px, py, pz
    mx, my, mz = into_box(own, nx, ny, nz)
    own[NORMAL], own[NORMAL + 1], own[NORMAL + 2] = mx, my, mz
    level = mx * own[CORNERS] + my * own[CORNERS + 1] + mz * own[CORNERS + 2]
    gap = -level - hx * abs(mx) - hy * abs(my) - hz * abs(mz)
    if gap > far:
        return FAR, gap, nx, ny, nz, face, px, py, pz
    kind, active, over = ON_TRIANGLE, links[8 * t + 6], True
    for k in range(3):  # planes square to the triangle through its edges
        i, j = CORNERS + 3 * k, CORNERS + 3 * ((k + 1) % 3)
        x, y, z = cross(own[j] - own[i], own[j + 1] - own[i + 1], own[j + 2] - own[i + 2], mx, my, mz)
        middle, wide = -(x * own[i] + y * own[i + 1] + z * own[i + 2]), hx * abs(x) + hy * abs(y) + hz * abs(z)
        scale = triangles[a + 12 + k]
        least, most = (middle - wide) * scale, (middle + wide) * scale
        if least > far:
            return FAR, least, nx, ny, nz, face, px, py, pz
        over = over and least <= OVER_EDGE
        if most < min(gap, 0.0):
            active &= ~(1 << k)  # all of the box is on this side of the edge, so that it meets something nearer
    if abs(mx) >= abs(my) and abs(mx) >= abs(mz):
        face = 0 if mx > 0.0 else 1
    elif abs(my) >= abs(mz):
        face = 2 if my > 0.0 else 3
    else:
        face = 4 if mz > 0.0 else 5
    most, border = gap, -1e300
    for d in range(3):
        for side in range(2):
            sign = 1.0 if side == 1 else -1.0
            corner, back = 0, 1e300
            for c in range(3):
                along = sign * own[CORNERS + 3 * c + d]
                if along < back:
                    corner, back = c, along
            back -= own[HALF + d]
            most = max(most, back)
            if back <= gap + BIAS:
                continue
            i = FRAME + 3 + 3 * d
            x, y, z = -sign * own[i], -sign * own[i + 1], -sign * own[i + 2]
            if is_tip(links, vertices, fan_start, fan, t, corner, x, y, z):
                kind, gap, face, nx, ny, nz = ON_FACE, back, 2 * d + side, x, y, z
            elif active & (1 << corner | 1 << (corner + 2) % 3):
                border = max(border, back)
    if active == 0:
        return settled(kind, over, gap, most, border), gap, nx, ny, nz, face, px, py, pz
    for k in range(3):
        if active & (1 << k) == 0:
            continue
        b, c, o = CORNERS + 3 * k, CORNERS + 3 * ((k + 1) % 3), CORNERS + 3 * ((k + 2) % 3)
        length = 1.0 / triangles[a + 12 + k]
        for d in range(3):
            i, j = (d + 1) % 3, (d + 2) % 3
            ui, uj = own[c + i] - own[b + i], own[c + j] - own[b + j]
            squared = ui * ui + uj * uj
            if ui == 0.0 or uj == 0.0 or squared <= PARALLEL_EDGES * length * length:
                continue
            scale = 1.0 / sqrt(squared)
            if uj * (own[o + i] - own[b + i]) - ui * (own[o + j] - own[b + j]) > 0.0:
                scale = -scale
            x, y = uj * scale, -ui * scale  # of the axis, along i and j
            vi = -own[HALF + i] if x > 0.0 else own[HALF + i]
            vj = -own[HALF + j] if y > 0.0 else own[HALF + j]
            di, dj = vi - own[b + i], vj - own[b + j]
            apart = x * di + y * dj
            low = vi * own[NORMAL + i] + vj * own[NORMAL + j] - own[HALF + d] * abs(own[NORMAL + d]) - level
            if apart <= gap + BIAS or low > far:
                continue
            most = max(most, apart)
            if x * own[NORMAL + i] + y * own[NORMAL + j] < 0.0:
                border = max(border, apart)
            along = (di * ui + dj * uj) / squared
            across = own[b + d] + along * (own[c + d] - own[b + d])
            if along < 0.0 or along > 1.0 or abs(across) > own[HALF + d]:
                continue
            ai, aj = FRAME + 3 + 3 * i, FRAME + 3 + 3 * j
            fx, fy, fz = (
                x * own[ai] + y * own[aj], x * own[ai + 1] + y * own[aj + 1], x * own[ai + 2] + y * own[aj + 2],
            )  # fmt: skip
            if not falls_away(links, vertices, fan_start, fan, t, EDGE + k, fx, fy, fz):
                border = max(border, apart)
                continue
            kind, gap, nx, ny, nz = ON_POINT, apart, fx, fy, fz
            ad = FRAME + 3 + 3 * d
            px = own[FRAME] + vi * own[ai] + vj * own[aj] + across * own[ad]
            py = own[FRAME + 1] + vi * own[ai + 1] + vj * own[aj + 1] + across * own[ad + 1]
            pz = own[FRAME + 2] + vi * own[ai + 2] + vj * own[aj + 2] + across * own[ad + 2]
    if most <= 0.0 or gap > far:
        return settled(kind, over, gap, most, border), gap, nx, ny, nz, face, px, py, pz
    shortest, qx, qy, qz, dx, dy, dz, part = 1e300, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0
    for k in range(3):
        if active & (1 << k) == 0:
            continue
        b, c, scale = CORNERS + 3 * k, CORNERS + 3 * ((k + 1) % 3), triangles[a + 12 + k]
        half = 0.5 / scale
        for d in range(3):
            own[MIDDLE + d] = 0.5 * (own[b + d] + own[c + d])
            own[ALONG + d] = (own[c + d] - own[b + d]) * scale
        s = nearest_to_box(own, half)
        x, y, z = beyond(own, 0, s), beyond(own, 1, s), beyond(own, 2, s)
        squared = x * x + y * y + z * z
        if squared < shortest:
            shortest, dx, dy, dz = squared, x, y, z
            qx, qy, qz = own[MIDDLE] + s * own[ALONG] - x, own[MIDDLE + 1] + s * own[ALONG + 1] - y, 0.0
            qz = own[MIDDLE + 2] + s * own[ALONG + 2] - z
            part = EDGE + k
            if s == -half:
                part = CORNER + k
            elif s == half:
                part = CORNER + (k + 1) % 3
    distance = sqrt(shortest)
    if shortest > max(gap, 0.0) * max(gap, 0.0) + OVER_EDGE * OVER_EDGE:  # beside what the gap is measured over
        x, y, z = out_of_box(own, -dx / distance, -dy / distance, -dz / distance)
        outer = part >= CORNER or not leads(
            vertices, 3 * links[8 * t + part], 3 * links[8 * t + (part + 2) % 3], x, y, z
        )
        if outer and falls_away(links, vertices, fan_start, fan, t, part, x, y, z):
            qx, qy, qz = out_of_box(own, qx, qy, qz)
            kind = ON_POINT if distance <= far else FAR
            return kind, distance, x, y, z, face, own[FRAME] + qx, own[FRAME + 1] + qy, own[FRAME + 2] + qz
    return settled(kind, over, gap, most, border), gap, nx, ny, nz, face, px, py, pz
