"""The direction in which two cores are parted: along their nearest points, or where they overlap least."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APART_LEAST, BRACKET
from carom.systems.kernels.cores import (
    CONE,
    CORE,
    EXTENT,
    FIRST,
    HALF_SPACE,
    KIND,
    OFFSET,
    POSITION,
    SEGMENT,
    farthest,
    out_of,
)
from carom.systems.kernels.distance import APART, FAR
from carom.systems.kernels.expansion import expand
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.nearing import near
from carom.systems.kernels.spatial import cross


@inlined
def part(core, place, vertices, overlap, x, y, z, reach, corner, face, plane, rim, name, weight, seen):
    """Return (gap, unit direction from first to second, point of the first) of two cores.

    ``overlap`` is whether FCL sees the shapes overlap, and x its normal, where it has one. The gap is infinite where it
    is beyond ``reach``. Cores that are apart have a nearest point; those that overlap are parted where it takes least,
    however deep, and concentric ones along any of the directions that take as little.
    """
    if core[CORE + KIND] == HALF_SPACE:
        if not overlap and core[KIND] != CONE:  # FCL sees it moved out by the reach; cones it misjudges
            return 1e300, x, y, z, 0.0, 0.0, 0.0
        return part_from_half_space(core, place, vertices)
    x, y, z = normal_or_centers(place, x, y, z)
    lines = core[KIND] <= SEGMENT and core[CORE + KIND] <= SEGMENT
    solid = core[KIND] > SEGMENT and core[CORE + KIND] > SEGMENT  # what FCL sees overlap are the cores themselves
    if overlap and solid:
        depth, x, y, z, px, py, pz = expand(core, place, vertices, x, y, z, corner, face, plane, rim)
        if depth >= -APART_LEAST:
            return -depth, x, y, z, px, py, pz
    state, gap, nx, ny, nz, px, py, pz = near(
        core, place, vertices, x, y, z, reach, BRACKET, corner, name, weight, seen
    )
    if state == FAR:
        return 1e300, x, y, z, px, py, pz
    if state == APART:
        return gap, nx, ny, nz, px, py, pz
    if lines:
        return part_lines(core, place, x, y, z)
    depth, x, y, z, px, py, pz = expand(core, place, vertices, x, y, z, corner, face, plane, rim)
    return -depth, x, y, z, px, py, pz


@inlined
def normal_or_centers(place, x, y, z):
    """Return FCL's normal, of which it has none for concentric bodies, or the direction between centres, or y."""
    squared = x * x + y * y + z * z
    if not 0.5 < squared < 2.0:
        x, y, z = place[POSITION], place[POSITION + 1], place[POSITION + 2]
        squared = x * x + y * y + z * z
    if not squared > 0.0:
        return 0.0, 1.0, 0.0
    scale = 1.0 / sqrt(squared)
    return x * scale, y * scale, z * scale


@inlined
def part_from_half_space(core, place, vertices):
    """Return what `part` does, into the half space."""
    x, y, z = out_of(place, core[CORE + EXTENT], core[CORE + EXTENT + 1], core[CORE + EXTENT + 2])
    offset = core[CORE + OFFSET] + x * place[POSITION] + y * place[POSITION + 1] + z * place[POSITION + 2]
    px, py, pz = farthest(core, FIRST, vertices, -x, -y, -z)
    return x * px + y * py + z * pz - offset, -x, -y, -z, px, py, pz


@inlined
def part_lines(core, place, x, y, z):
    """Return what `part` does of points and segments that meet: along the common normal of two segments.

    Of those in one line, and of a point on a segment, along x of the frame of the segment; of two points as it came.
    """
    px, py, pz = 0.0, 0.0, 0.0
    if core[KIND] == SEGMENT:
        py = min(max(place[POSITION + 1], -core[EXTENT + 1]), core[EXTENT + 1])
        ux, uy, uz = 1.0, 0.0, 0.0
        if core[CORE + KIND] == SEGMENT:
            vx, vy, vz = out_of(place, 0.0, 1.0, 0.0)
            vx, vy, vz = cross(0.0, 1.0, 0.0, vx, vy, vz)
            length = sqrt(vx * vx + vy * vy + vz * vz)
            if length > APART_LEAST:
                ux, uy, uz = vx / length, vy / length, vz / length
        return 0.0, ux, uy, uz, px, py, pz
    if core[CORE + KIND] == SEGMENT:
        x, y, z = out_of(place, 1.0, 0.0, 0.0)
    return 0.0, x, y, z, px, py, pz
