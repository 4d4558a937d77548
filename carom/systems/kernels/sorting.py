"""Which contacts rest in a substep, and which are left to impacts."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APPROACH, REST_SPEED_FACTOR, SLOP, TOUCH
from carom.systems.kernels.balls import gap_of_ball
from carom.systems.kernels.bodies import pressed_by_forces, surface_velocity
from carom.systems.kernels.kernel import kernel


@kernel(
    "normal", "depth", "point", "offset_a", "offset_b", "resting", "touching",
    "warm_normal", "warm_friction", "warm_rolling",
)  # fmt: skip
def sort_contacts(
    count, h, resting_stage, center, rotation, linear, angular, felt,
    kind, ball, other, sign, radius, extent, other_position, other_rotation, body_a, body_b,
    normal, depth, point, offset_a, offset_b, resting, touching, warm_normal, warm_friction, warm_rolling,
):  # fmt: skip
    """Say which contacts rest at the start of the substep, mark their bodies, and return how many they are.

    A ball's pair is measured anew. It rests when it touches, closes no faster than the rest speed and would not be
    clear of the other at the end of the substep. Any other shape's contact takes part once it would close by then.
    """
    number = 0
    for c in range(count):
        if kind[c] >= 0:
            i, o = ball[c], other[c]
            ox, oy, oz = other_position[c, 0], other_position[c, 1], other_position[c, 2]
            qx, qy, qz, qw = other_rotation[c, 0], other_rotation[c, 1], other_rotation[c, 2], other_rotation[c, 3]
            if o >= 0:
                ox, oy, oz = center[o, 0], center[o, 1], center[o, 2]
                qx, qy, qz, qw = rotation[o, 0], rotation[o, 1], rotation[o, 2], rotation[o, 3]
            gap, nx, ny, nz = gap_of_ball(
                kind[c], center[i, 0], center[i, 1], center[i, 2], radius[c], ox, oy, oz, qx, qy, qz, qw,
                extent[c, 0], extent[c, 1], extent[c, 2],
            )  # fmt: skip
            depth[c] = -gap
            lever = radius[c] + 0.5 * gap
            for k, n in enumerate((nx, ny, nz)):
                normal[c, k] = -sign[c] * n
                point[c, k] = center[i, k] - lever * n
                to_ball = -lever * n
                to_other = point[c, k] - (center[o, k] if o >= 0 else other_position[c, k])
                offset_a[c, k] = to_ball if sign[c] > 0.0 else to_other
                offset_b[c, k] = to_other if sign[c] > 0.0 else to_ball
        a, b = body_a[c], body_b[c]
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        ax, ay, az = surface_velocity(a, offset_a[c, 0], offset_a[c, 1], offset_a[c, 2], linear, angular)
        bx, by, bz = surface_velocity(b, offset_b[c, 0], offset_b[c, 1], offset_b[c, 2], linear, angular)
        parting = nx * (bx - ax) + ny * (by - ay) + nz * (bz - az)
        pressing = pressed_by_forces(a, b, nx, ny, nz, felt)
        gap = -depth[c]
        after = gap + parting * h - 0.5 * pressing * h * h
        if kind[c] >= 0:
            rests = gap <= TOUCH and -parting <= max(APPROACH, REST_SPEED_FACTOR * pressing * h) and after <= 0.0
        else:
            rests = (gap <= SLOP and after <= SLOP) or after <= 0.0
        resting[c] = rests and resting_stage
        if resting[c]:
            number += 1
            if a >= 0:
                touching[a] = True
            if b >= 0:
                touching[b] = True
        else:
            warm_normal[c] = 0.0
            for k in range(3):
                warm_friction[c, k] = 0.0
                warm_rolling[c, k] = 0.0
    return number
