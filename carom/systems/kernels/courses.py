"""Courses: the ways of shapes within a substep that has been flown, and their poses on them."""

from __future__ import annotations

from math import inf, pi, sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import ANGLE_STEPS
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.narrow import POINT_SHAPE, SPHERE_SHAPE
from carom.systems.kernels.spatial import product, sine_cosine, turn
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh

MESH_SHAPE, HEIGHT_FIELD_SHAPE = Mesh.number, HeightField.number


@kernel("begin", "middle", "end", "early", "late", "knot", "speed", "bend")
def chart_courses(
    rows, local, span, share, body_row, center_of_mass, start_position, start_rotation, center, rotation,
    linear, acceleration, struck, strikes, shape, shape_position, bound_center, bound_half, bound_radius,
    begin, middle, end, early, late, knot, speed, bend,
):  # fmt: skip
    """Write the courses of the shapes ``rows`` (n, 2), by pair and side, whose bodies have flown ``span`` seconds.

    A centre of mass goes from ``begin`` by ``middle``, where it was at ``knot`` (s), to ``end``, on arcs off their
    chords by ``early`` and ``late`` (m/s2) times the time since one end and that until the other. ``share`` of an
    acceleration bends an arc. A body was ``struck`` last at that time (s, 0 for never): from then on its arc is known
    by where it ends, and before it is another one, straight where there were more ``strikes``.

    ``speed`` (m/s) and ``bend`` (m/s2) bound how fast the gap of a pair changes, and how fast that does; where a shape
    is not convex the second is infinite.
    """
    for p in range(len(rows)):
        speed[p], bend[p] = 0.0, 0.0
        for side in range(2):
            i = rows[p, side]
            b = body_row[i]
            knot[p, side] = 0.0
            if shape[i] == MESH_SHAPE or shape[i] == HEIGHT_FIELD_SHAPE:
                bend[p] = inf
            if b < 0:
                continue
            at = struck[b]
            knot[p, side], left = at, span - at
            mx, my, mz = turn(
                start_rotation[b, 0], start_rotation[b, 1], start_rotation[b, 2], start_rotation[b, 3],
                center_of_mass[b, 0], center_of_mass[b, 1], center_of_mass[b, 2],
            )  # fmt: skip
            for k, offset in enumerate((mx, my, mz)):
                a = acceleration[b, k]
                begin[p, side, k], end[p, side, k] = start_position[b, k] + offset, center[b, k]
                middle[p, side, k] = begin[p, side, k]
                if at > 0.0:
                    middle[p, side, k] = center[b, k] - linear[b, k] * left + (1.0 - share) * a * left * left
                early[p, side, k] = share * a if strikes[b] == 1 else 0.0
                late[p, side, k] = share * a
            first, second, pull, lever, half, chord, other = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
            for k in range(3):
                first += (middle[p, side, k] - begin[p, side, k]) ** 2
                second += (end[p, side, k] - middle[p, side, k]) ** 2
                pull += late[p, side, k] ** 2
                lever += (local[p, side, k] - center_of_mass[b, k]) ** 2
                half += bound_half[i, k] ** 2
                other += (bound_center[i, k] - shape_position[i, k]) ** 2
            ball = shape[i] == SPHERE_SHAPE or shape[i] == POINT_SHAPE
            radius = 0.0 if ball else sqrt(half) + sqrt(other) + bound_radius[i]
            lever, pull, other = sqrt(lever) + radius, 2.0 * sqrt(pull), 0.0
            for k in range(4):
                chord += (rotation[b, k] - start_rotation[b, k]) ** 2
                other += (rotation[b, k] + start_rotation[b, k]) ** 2
            spin = pi * sqrt(min(chord, other)) / span  # the chord is twice the sine of a quarter of the angle
            quick = max(sqrt(first) / at if at > 0.0 else 0.0, sqrt(second) / left)
            speed[p] += quick + pull * span + spin * lever
            bend[p] += pull + spin * spin * lever


@kernel("pose_position", "pose_rotation")
def place_on_courses(
    which, times, rows, local, turned, span, body_row, center_of_mass, start_rotation, rotation,
    begin, middle, end, early, late, knot, pose_position, pose_rotation,
):  # fmt: skip
    """Place both shapes of pairs ``which`` where they were at ``times`` (s); rotation is even throughout."""
    for w in range(len(which)):
        p, time = which[w], times[w]
        for side in range(2):
            i = rows[p, side]
            b = body_row[i]
            if b < 0:
                continue
            at = knot[p, side]
            qx, qy, qz, qw = between(
                start_rotation[b, 0], start_rotation[b, 1], start_rotation[b, 2], start_rotation[b, 3],
                rotation[b, 0], rotation[b, 1], rotation[b, 2], rotation[b, 3], time / span,
            )  # fmt: skip
            ox, oy, oz = turn(
                qx, qy, qz, qw, local[p, side, 0] - center_of_mass[b, 0],
                local[p, side, 1] - center_of_mass[b, 1], local[p, side, 2] - center_of_mass[b, 2],
            )  # fmt: skip
            for k, offset in enumerate((ox, oy, oz)):
                if time < at:
                    place = begin[p, side, k] + (middle[p, side, k] - begin[p, side, k]) * (time / at)
                    place -= early[p, side, k] * time * (at - time)
                else:
                    place = middle[p, side, k] + (end[p, side, k] - middle[p, side, k]) * ((time - at) / (span - at))
                    place -= late[p, side, k] * (time - at) * (span - time)
                pose_position[i, k] = place + offset
            pose_rotation[i, 0], pose_rotation[i, 1], pose_rotation[i, 2], pose_rotation[i, 3] = product(
                qx, qy, qz, qw, turned[p, side, 0], turned[p, side, 1], turned[p, side, 2], turned[p, side, 3]
            )


@inlined
def between(ax, ay, az, aw, bx, by, bz, bw, part):
    """Return the rotation ``part`` of the shorter way from a to b, at constant angular speed."""
    x, y, z, w = product(bx, by, bz, bw, -ax, -ay, -az, aw)
    sine = sqrt(x * x + y * y + z * z)
    if sine == 0.0 or part == 0.0:
        return ax, ay, az, aw
    if w < 0.0:
        x, y, z, w = -x, -y, -z, -w
    angle = 0.0  # half of it; each step of Newton's method on the sine of what is left cubes the error
    for _ in range(ANGLE_STEPS):
        s, c = sine_cosine(angle)
        angle += sine * c - w * s
    s, c = sine_cosine(part * angle)
    scale = s / sine
    return product(x * scale, y * scale, z * scale, c, ax, ay, az, aw)
