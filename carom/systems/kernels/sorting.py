"""Which manifolds rest in a substep, and which are left to impacts."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APPROACH, REST_SPEED_FACTOR, SLOP, TOUCH
from carom.systems.kernels.balls import gap_of_ball, pose_of_other
from carom.systems.kernels.blows import slip_of_pair
from carom.systems.kernels.bodies import pressed_by_forces, pushed
from carom.systems.kernels.kernel import inlined, kernel


@kernel(
    "normal", "depth", "point", "offset_a", "offset_b", "resting", "touching",
    "warm_normal", "warm_friction", "warm_rolling",
)  # fmt: skip
def sort_manifolds(
    count, start, h, resting_stage, center, rotation, linear, angular, felt,
    kind, ball, other, sign, radius, extent, other_position, other_rotation, body_a, body_b, restitution,
    normal, depth, point, offset_a, offset_b, resting, touching, warm_normal, warm_friction, warm_rolling,
):  # fmt: skip
    """Say which manifolds rest at the start of the substep, mark their bodies, and return how many they are.

    One rests when one of its points touches or would by the end of the substep (a ball only once it touches), unless
    one would strike: close faster than the rest speed. What was pressed together before and has no exact arc goes on
    resting.
    """
    number = 0
    for m in range(count):
        near, strikes, held = False, False, False
        for c in range(start[m], start[m + 1]):
            held |= warm_normal[c] > 0.0
            if kind[c] >= 0:
                measure_ball(
                    c, center, rotation, kind, ball, other, sign, radius, extent, other_position, other_rotation,
                    normal, depth, point, offset_a, offset_b,
                )  # fmt: skip
            a, b = body_a[c], body_b[c]
            nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
            sx, sy, sz = slip_of_pair(c, a, b, offset_a, offset_b, linear, angular)
            closing = -(nx * sx + ny * sy + nz * sz)
            pressing = pressed_by_forces(a, b, nx, ny, nz, felt)
            # Without restitution there is no bounce to lose by resting, so that all that forces do counts.
            slow = max(0.0, pressing if restitution[c] > 0.0 else pushed(a, b, felt))
            gap = -depth[c]
            after = gap - closing * h - 0.5 * pressing * h * h
            strikes |= after <= 0.0 and closing > APPROACH + REST_SPEED_FACTOR * slow * h
            if kind[c] >= 0:
                near |= gap <= TOUCH and after <= 0.0
            else:
                near |= after <= (SLOP if gap <= SLOP else 0.0)
        held &= kind[start[m]] < 0
        rests = near and (held or not strikes) and resting_stage
        number += rests
        for c in range(start[m], start[m + 1]):
            resting[c] = rests
            if rests:
                for body in (body_a[c], body_b[c]):
                    if body >= 0:
                        touching[body] = True
            else:
                warm_normal[c] = 0.0
                for k in range(3):
                    warm_friction[c, k], warm_rolling[c, k] = 0.0, 0.0
    return number


@inlined
def measure_ball(
    c, center, rotation, kind, ball, other, sign, radius, extent, other_position, other_rotation,
    normal, depth, point, offset_a, offset_b,
):  # fmt: skip
    """Measure the contact of a ball anew, where its bodies are.

    The offsets lead to the surface of each, not to the point midway: what rolls on an overlap rolls on its own radius.
    """
    i, o = ball[c], other[c]
    ox, oy, oz, qx, qy, qz, qw = pose_of_other(c, o, center, rotation, other_position, other_rotation)
    gap, nx, ny, nz = gap_of_ball(
        kind[c], center[i, 0], center[i, 1], center[i, 2], radius[c], ox, oy, oz, qx, qy, qz, qw,
        extent[c, 0], extent[c, 1], extent[c, 2],
    )  # fmt: skip
    depth[c] = -gap
    for k, n in enumerate((nx, ny, nz)):
        normal[c, k] = -sign[c] * n
        point[c, k] = center[i, k] - (radius[c] + 0.5 * gap) * n
        to_ball = -radius[c] * n
        to_other = center[i, k] - (radius[c] + gap) * n - (center[o, k] if o >= 0 else other_position[c, k])
        offset_a[c, k] = to_ball if sign[c] > 0.0 else to_other
        offset_b[c, k] = to_other if sign[c] > 0.0 else to_ball
