"""Narrow phase of balls and points against balls, points, boxes and half spaces, in closed form."""

from __future__ import annotations

from carom.systems.kernels.balls import HALF_SPACE, gap_of_ball, gap_of_balls

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.narrow import is_ball, kind_and_extent
from carom.systems.kernels.writing import write_point


@shared("start", "count", "feature", "normal", "depth", "point")
def measure_balls(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs whose first collider is a ball or point.

    Every function of the narrow phase has this form: pair ``which[k]`` has the collider rows ``first[k]`` and
    ``second[k]``; its points are written where they are nearer than ``reaches[which[k]]``, behind those ``taken`` so
    far, with ``room`` for so many of each pair; ``apart`` is how far (m) from each other those at least are that have
    none, 0 where nobody says, as of balls, which are soon measured again. ``hulls`` and ``meshes`` are those of
    `PackedHulls` and `PackedMeshes`.
    """
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for k in range(begin, end):
        p, i, o = which[k], first[k], second[k]
        radius, x, y, z = size[i, 0], position[i, 0], position[i, 1], position[i, 2]
        ox, oy, oz = position[o, 0], position[o, 1], position[o, 2]
        if is_ball(o, shape):  # most often: how it is turned need not be read
            gap, nx, ny, nz = gap_of_balls(x - ox, y - oy, z - oz, radius + size[o, 0])
        else:
            kind, ex, ey, ez = kind_and_extent(
                shape[o], size[o, 0], size[o, 1], size[o, 2],
                rotation[o, 0], rotation[o, 1], rotation[o, 2], rotation[o, 3],
            )  # fmt: skip
            if kind == HALF_SPACE:
                ox, oy, oz = ox + size[o, 3] * ex, oy + size[o, 3] * ey, oz + size[o, 3] * ez
            gap, nx, ny, nz = gap_of_ball(
                kind, x, y, z, radius, ox, oy, oz,
                rotation[o, 0], rotation[o, 1], rotation[o, 2], rotation[o, 3], ex, ey, ez,
            )  # fmt: skip
        lever = radius + 0.5 * gap
        write_point(
            taken, 0, gap, -nx, -ny, -nz,
            x - lever * nx, y - lever * ny, z - lever * nz,
            feature, normal, depth, point,
        )  # fmt: skip
        # No branch: who is near is past foreseeing. What is not counted is written over.
        start[p], count[p] = taken, 0 if gap > reaches[p] else 1
        taken += count[p]
