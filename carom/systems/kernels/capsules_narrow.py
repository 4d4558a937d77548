"""Narrow phase of capsules against balls, points and each other, in closed form."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import ALONG, BIAS, LEAST_PART
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.frames import turned, turned_back
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.segments import beside, direction_between, nearest_of_segments
from carom.systems.kernels.spatial import cross
from carom.systems.kernels.writing import write_point

ALONE = 2  # feature; points of capsules side by side are 0 and 1 along the first


@shared("start", "count", "feature", "normal", "depth", "point")
def measure_balls_on_capsules(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of a ball or point and a capsule.

    A ball whose centre is on the capsule's axis is as far from all sides: the way out is along the capsule's x.
    """
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for k in range(begin, end):
        p, i, o = which[k], first[k], second[k]
        start[p] = taken
        dx, dy, dz = position[i, 0] - position[o, 0], position[i, 1] - position[o, 1], position[i, 2] - position[o, 2]
        x, y, z = turned_back(rotation, o, dx, dy, dz)
        half = 0.5 * size[o, 1]
        y -= min(max(y, -half), half)
        length = sqrt(x * x + y * y + z * z)
        gap = length - size[o, 0] - size[i, 0]
        if not gap <= reaches[p]:
            continue
        if length > LEAST_PART:
            x, y, z = x / length, y / length, z / length
        else:
            x, y, z = 1.0, 0.0, 0.0
        nx, ny, nz = turned(rotation, o, x, y, z)
        lever = size[i, 0] + 0.5 * gap
        count[p] = 1
        write_point(
            taken, 0, gap, -nx, -ny, -nz,
            position[i, 0] - lever * nx, position[i, 1] - lever * ny, position[i, 2] - lever * nz,
            feature, normal, depth, point,
        )  # fmt: skip
        taken += 1


@shared("start", "count", "apart", "feature", "normal", "depth", "point")
def measure_capsules(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of capsules.

    Capsules along each other (ALONG) have two points, at the ends of what lies side by side; others one. Where the
    axes meet the way out is their common normal. The longer capsule goes first in the arithmetic, so that swapping
    capsules of different length turns normals and changes no other bit.
    """
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for k in range(begin, end):
        p, i, o, sense = which[k], first[k], second[k], 1.0
        start[p], reach = taken, reaches[p]
        if size[o, 1] > size[i, 1]:
            i, o, sense = o, i, -1.0
        radius_i, radius_o, half_i, half_o = size[i, 0], size[o, 0], 0.5 * size[i, 1], 0.5 * size[o, 1]
        dx, dy, dz = position[o, 0] - position[i, 0], position[o, 1] - position[i, 1], position[o, 2] - position[i, 2]
        ux, uy, uz = turned(rotation, i, 0.0, 1.0, 0.0)
        vx, vy, vz = turned(rotation, o, 0.0, 1.0, 0.0)
        s, t = nearest_of_segments(dx, dy, dz, ux, uy, uz, half_i, vx, vy, vz, half_o)
        nearest = between(dx, dy, dz, ux, uy, uz, s, vx, vy, vz, t)
        apart[p] = nearest - radius_i - radius_o
        if not apart[p] <= reach:
            continue
        low, high, t_low, t_high, two = s, s, t, t, False
        if parallel(ux, uy, uz, vx, vy, vz):
            cosine, along_v = ux * vx + uy * vy + uz * vz, dx * vx + dy * vy + dz * vz
            low, high = beside(dx * ux + dy * uy + dz * uz, cosine, half_i, half_o)
            t_low = min(max(cosine * low - along_v, -half_o), half_o)
            t_high = min(max(cosine * high - along_v, -half_o), half_o)
            at_low = between(dx, dy, dz, ux, uy, uz, low, vx, vy, vz, t_low)
            at_high = between(dx, dy, dz, ux, uy, uz, high, vx, vy, vz, t_high)
            two = low < high and min(at_low, at_high) <= nearest + BIAS
        for end in range(2 if two else 1):
            if two:
                s, t = (high, t_high) if end == 1 else (low, t_low)
            wx, wy, wz = dx + t * vx - s * ux, dy + t * vy - s * uy, dz + t * vz - s * uz
            length, nx, ny, nz = direction_between(wx, wy, wz, ux, uy, uz, vx, vy, vz)
            gap = length - radius_i - radius_o
            if gap > reach:
                continue
            lever = radius_i + 0.5 * gap
            write_point(
                taken, end if two else ALONE, gap, sense * nx, sense * ny, sense * nz,
                position[i, 0] + s * ux + lever * nx,
                position[i, 1] + s * uy + lever * ny,
                position[i, 2] + s * uz + lever * nz,
                feature, normal, depth, point,
            )  # fmt: skip
            taken += 1
        count[p] = taken - start[p]


@inlined
def between(dx, dy, dz, ux, uy, uz, s, vx, vy, vz, t):
    """Return the distance of the points s u and d + t v."""
    wx, wy, wz = dx + t * vx - s * ux, dy + t * vy - s * uy, dz + t * vz - s * uz
    return sqrt(wx * wx + wy * wy + wz * wz)


@inlined
def parallel(ux, uy, uz, vx, vy, vz):
    """Tell whether capsules along u and v lie along each other."""
    nx, ny, nz = cross(ux, uy, uz, vx, vy, vz)
    return nx * nx + ny * ny + nz * nz < ALONG
