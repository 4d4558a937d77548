"""Narrow phase of boxes and capsules against half spaces: one point for each corner or end near it."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.frames import placed, turned, turned_back
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.writing import write_point

FLAT = 1e-9  # part of a half edge: axes leaning less towards the plane than another one by this count as equal


@inlined
def plane_of(size, position, rotation, row):
    """Return (normal, offset) of a half space: it is solid where n.x < offset."""
    nx, ny, nz = turned(rotation, row, size[row, 0], size[row, 1], size[row, 2])
    offset = size[row, 3] + nx * position[row, 0] + ny * position[row, 1] + nz * position[row, 2]
    return nx, ny, nz, offset


@shared("start", "count", "feature", "normal", "depth", "point")
def measure_boxes_on_planes(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of a box and a half space.

    The points are corners of the face that faces the half space most, numbered by their signs: x + 2 y + 4 z. The
    depth is that under the surface, however deep the box lies.
    """
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for k in range(begin, end):
        p, i, o = which[k], first[k], second[k]
        start[p], reach = taken, reaches[p]
        nx, ny, nz, offset = plane_of(size, position, rotation, o)
        lx, ly, lz = turned_back(rotation, i, nx, ny, nz)
        height = nx * position[i, 0] + ny * position[i, 1] + nz * position[i, 2] - offset
        hx, hy, hz = 0.5 * size[i, 0], 0.5 * size[i, 1], 0.5 * size[i, 2]
        if not height - hx * abs(lx) - hy * abs(ly) - hz * abs(lz) <= reach:
            continue
        most, axis, front = abs(lx), 0, 0 if lx > 0.0 else 1
        if abs(ly) > most + FLAT:
            most, axis, front = abs(ly), 1, 0 if ly > 0.0 else 1
        if abs(lz) > most + FLAT:
            axis, front = 2, 0 if lz > 0.0 else 1
        found = 0
        for corner in range(8):
            if (corner >> axis) & 1 != front:
                continue
            x, y, z = hx if corner & 1 else -hx, hy if corner & 2 else -hy, hz if corner & 4 else -hz
            gap = height + lx * x + ly * y + lz * z
            if gap > reach:
                continue
            px, py, pz = placed(position, rotation, i, x, y, z)
            write_point(
                taken + found, corner, gap, -nx, -ny, -nz,
                px - 0.5 * gap * nx, py - 0.5 * gap * ny, pz - 0.5 * gap * nz,
                feature, normal, depth, point,
            )  # fmt: skip
            found += 1
        count[p] = found
        taken += found


@shared("start", "count", "feature", "normal", "depth", "point")
def measure_capsules_on_planes(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of a capsule and a half space.

    The points are under the ball at either end, the lower along the capsule's axis being feature 0.
    """
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for k in range(begin, end):
        p, i, o = which[k], first[k], second[k]
        start[p] = taken
        nx, ny, nz, offset = plane_of(size, position, rotation, o)
        radius, half = size[i, 0], 0.5 * size[i, 1]
        for end in range(2):
            x, y, z = placed(position, rotation, i, 0.0, half if end == 1 else -half, 0.0)
            gap = nx * x + ny * y + nz * z - offset - radius
            if not gap <= reaches[p]:
                continue
            lever = radius + 0.5 * gap
            write_point(
                taken, end, gap, -nx, -ny, -nz, x - lever * nx, y - lever * ny, z - lever * nz,
                feature, normal, depth, point,
            )  # fmt: skip
            taken += 1
        count[p] = taken - start[p]
