"""Narrow phase of balls in closed form."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.balls import BALL, BOX, HALF_SPACE, gap_of_ball
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.spatial import turn
from carom.systems.shapes.box import Box
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.point import Point
from carom.systems.shapes.sphere import Sphere

SPHERE_SHAPE, POINT_SHAPE, BOX_SHAPE, PLANE_SHAPE = Sphere.number, Point.number, Box.number, Plane.number


@kernel("reaches")
def reach_of_pairs(pairs, body_row, reach, reaches):
    """Write how near (m) each pair must come to be a contact: what its two bodies reach within the step."""
    for p in range(len(pairs)):
        reaches[p] = 0.0
        for side in range(2):
            body = body_row[pairs[p, side]]
            if body >= 0:
                reaches[p] += reach[body]


@kernel("answered", "found_a", "found_b", "normal", "depth", "point")
def measure_balls(
    pairs, reaches, shape, size, pose_position, pose_rotation, answered, found_a, found_b, normal, depth, point
):
    """Measure the pairs that have a closed form and return (how many those were, how many are within reach).

    These are ball or point against ball, point, box and half space. They are marked in ``answered``; those within reach
    are written one after another.
    """
    answers, count = 0, 0
    for p in range(len(pairs)):
        answered[p] = False
        a, b = pairs[p, 0], pairs[p, 1]
        sign = 1.0
        i, o = a, b
        if shape[i] != SPHERE_SHAPE and shape[i] != POINT_SHAPE:
            i, o, sign = b, a, -1.0
        if shape[i] != SPHERE_SHAPE and shape[i] != POINT_SHAPE:
            continue
        kind, ex, ey, ez = kind_and_extent(
            shape[o], size[o, 0], size[o, 1], size[o, 2],
            pose_rotation[o, 0], pose_rotation[o, 1], pose_rotation[o, 2], pose_rotation[o, 3],
        )  # fmt: skip
        if kind < 0:
            continue
        ox, oy, oz = pose_position[o, 0], pose_position[o, 1], pose_position[o, 2]
        if kind == HALF_SPACE:
            ox, oy, oz = ox + size[o, 3] * ex, oy + size[o, 3] * ey, oz + size[o, 3] * ez
        radius = size[i, 0]
        gap, nx, ny, nz = gap_of_ball(
            kind, pose_position[i, 0], pose_position[i, 1], pose_position[i, 2], radius, ox, oy, oz,
            pose_rotation[o, 0], pose_rotation[o, 1], pose_rotation[o, 2], pose_rotation[o, 3], ex, ey, ez,
        )  # fmt: skip
        answered[p] = True
        answers += 1
        if gap > reaches[p]:
            continue
        lever = radius + 0.5 * gap
        found_a[count], found_b[count], depth[count] = a, b, -gap
        normal[count, 0], normal[count, 1], normal[count, 2] = -sign * nx, -sign * ny, -sign * nz
        point[count, 0] = pose_position[i, 0] - lever * nx
        point[count, 1] = pose_position[i, 1] - lever * ny
        point[count, 2] = pose_position[i, 2] - lever * nz
        count += 1
    return answers, count


@inlined
def kind_and_extent(shape, sx, sy, sz, qx, qy, qz, qw):
    """Return how `gap_of_ball` reads a shape, and its extent; kind -1 where it has no closed form."""
    if shape in (SPHERE_SHAPE, POINT_SHAPE):
        return BALL, sx, 0.0, 0.0
    if shape == BOX_SHAPE:
        return BOX, 0.5 * sx, 0.5 * sy, 0.5 * sz
    if shape == PLANE_SHAPE:
        nx, ny, nz = turn(qx, qy, qz, qw, sx, sy, sz)
        return HALF_SPACE, nx, ny, nz
    return -1, 0.0, 0.0, 0.0
