"""Contacts of balls, measured anew in the contact table: one by one, or a group of those on what belongs to nobody."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import groups as of
from carom.systems.kernels.ball_seams import is_borne_beside
from carom.systems.kernels.balls import gap_of_ball, pose_of_other
from carom.systems.kernels.balls_on_still import measure_on_still
from carom.systems.kernels.filling import places_of
from carom.systems.kernels.groups import MANIFOLD_ROWS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lanes import WIDTH, address, load


@woven
def measure_balls_on_still(
    g, r, first, size, beside, center, rotation, kind, ball, other, sign, radius, extent,
    other_position, other_rotation, normal, depth, point, offset_a, offset_b, lanes,
):  # fmt: skip
    """Measure the contacts of a group of balls on what belongs to no body anew, in its lanes and in the table."""
    across = measure_on_still(
        r, places_of(g, 0, first, size), load(address(lanes), r + of.SHARE), center, kind, ball, sign, radius, extent,
        other_position, other_rotation, address(lanes),
    )  # fmt: skip
    for lane in range(WIDTH):
        c = first[g, lane]
        if c < 0:
            continue
        gap, sense, n = -lanes[r + MANIFOLD_ROWS + of.DEPTH, lane], -sign[c], r + of.NORMAL
        write_ball(
            c, gap, sense * lanes[n, lane], sense * lanes[n + 1, lane], sense * lanes[n + 2, lane],
            center, ball, other, sign, radius, other_position, normal, depth, point, offset_a, offset_b,
        )  # fmt: skip
        lanes[r + of.BESIDE, lane] = (across >> lane & 1) and is_borne_beside(
            c, beside, center, rotation, ball, other, sign, radius, extent, other_position, other_rotation,
            normal, depth,
        )  # fmt: skip


@woven
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
    write_ball(
        c, gap, nx, ny, nz, center, ball, other, sign, radius, other_position, normal, depth, point, offset_a, offset_b
    )


@woven
def write_ball(
    c, gap, nx, ny, nz, center, ball, other, sign, radius, other_position, normal, depth, point, offset_a, offset_b
):
    """Write the contact of a ball by its gap and the normal that points from the other to it."""
    i, o = ball[c], other[c]
    depth[c] = -gap
    for k, n in enumerate((nx, ny, nz)):
        normal[c, k] = -sign[c] * n
        point[c, k] = center[i, k] - (radius[c] + 0.5 * gap) * n
        to_ball = -radius[c] * n
        to_other = center[i, k] - (radius[c] + gap) * n - (center[o, k] if o >= 0 else other_position[c, k])
        offset_a[c, k] = to_ball if sign[c] > 0.0 else to_other
        offset_b[c, k] = to_other if sign[c] > 0.0 else to_ball
