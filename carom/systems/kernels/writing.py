"""Contact points as the narrow phase writes them down."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined, woven


@woven
def write_point(at, name, gap, nx, ny, nz, x, y, z, feature, normal, depth, point):
    """Write a point, numbered ``name``, at place x with normal n."""
    feature[at], depth[at] = name, -gap
    normal[at, 0], normal[at, 1], normal[at, 2] = nx, ny, nz
    point[at, 0], point[at, 1], point[at, 2] = x, y, z


@inlined
def write_points(
    place, gaps, names, count, x, y, z, nx, ny, nz, side, radius, other_radius,
    taken, feature, normal, depth, point,
):  # fmt: skip
    """Write points of the first core, counted from x, and their gaps to the second as contacts; return what is taken.

    n points from first to second; ``side`` is -1 where the caller counts the two the other way round.
    """
    for k in range(count):
        gap = gaps[k] - radius - other_radius
        lever = radius + 0.5 * gap
        write_point(
            taken, names[k], gap, side * nx, side * ny, side * nz,
            x + place[3 * k] + lever * nx, y + place[3 * k + 1] + lever * ny, z + place[3 * k + 2] + lever * nz,
            feature, normal, depth, point,
        )  # fmt: skip
        taken += 1
    return taken
