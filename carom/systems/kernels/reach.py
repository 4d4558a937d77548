"""Reach: how far bodies can fly, and for how long what detection foresaw holds for them as they move now."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import REACH_FACTOR, ROOT_GAP
from carom.systems.kernels.balls import BALL, gap_of_ball
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lane_columns import ALL, in_a_row, load_one, load_three
from carom.systems.kernels.lanes import WIDTH, address, spread, which

WELL_WITHIN = 3.001  # a little more than 3, whatever rounding does


@woven
def way_within(i, span, stream, linear, acceleration):
    """Return how far (m) from where the stream takes it body i can fly within ``span`` seconds."""
    quick, push = 0.0, 0.0
    for k in range(3):
        quick += (linear[i, k] - stream[0, k]) ** 2
        push += acceleration[i, k] ** 2
    return (sqrt(quick) + 0.5 * sqrt(push) * span) * span


@woven
def are_apart(p, i, o, span, center, linear, acceleration, other_position, radius, extent):
    """Tell whether the ball i of pair p and the ball o, or what stands there, are too far apart to meet in time."""
    away, quick, push = 0.0, 0.0, 0.0
    for k in range(3):
        away += (center[i, k] - (center[o, k] if o >= 0 else other_position[p, k])) ** 2
        quick += linear[i, k] ** 2 + (linear[o, k] ** 2 if o >= 0 else 0.0)
        push += acceleration[i, k] ** 2 + (acceleration[o, k] ** 2 if o >= 0 else 0.0)
    # Four lengths are no longer than twice the root of their squares: the ways at both speeds and accelerations.
    way = 2.0 * span * sqrt(quick + 0.25 * span * span * push)
    return away > (radius[p] + extent[p, 0] + way + ROOT_GAP) ** 2


@woven
def stay_apart(p, i, o, span, kind, center, linear, acceleration, other_position, other_rotation, radius, extent):
    """Tell whether the ball i of pair p and the ball o, or what stands there, close too slowly to meet in time.

    Both are convex: they part by no less than the planes across the line on which they are nearest now.
    """
    if o >= 0 and kind[p] != BALL:
        return False
    x, y, z = other_position[p, 0], other_position[p, 1], other_position[p, 2]
    if o >= 0:
        x, y, z = center[o, 0], center[o, 1], center[o, 2]
    gap, nx, ny, nz = gap_of_ball(
        kind[p], center[i, 0], center[i, 1], center[i, 2], radius[p], x, y, z, other_rotation[p, 0],
        other_rotation[p, 1], other_rotation[p, 2], other_rotation[p, 3], extent[p, 0], extent[p, 1], extent[p, 2],
    )  # fmt: skip
    closing, push = 0.0, 0.0
    for k, n in enumerate((nx, ny, nz)):
        closing -= n * (linear[i, k] - (linear[o, k] if o >= 0 else 0.0))
        push += (acceleration[i, k] - (acceleration[o, k] if o >= 0 else 0.0)) ** 2
    return gap > (max(closing, 0.0) + 0.5 * span * sqrt(push)) * span + ROOT_GAP


@woven
def time_within_reach(i, span, since, stream, center, detected_center, reach, linear, acceleration):
    """Return for how long (s, at most ``span``) body i cannot leave its reach.

    It may fly anywhere at its speed and acceleration: what strikes it later is asked about then. The way of the stream
    is that of ``since`` seconds ago.
    """
    away, quick, push = 0.0, 0.0, 0.0
    for k in range(3):
        away += (center[i, k] - detected_center[i, k] - stream[1, k] - since * stream[0, k]) ** 2
        quick += (linear[i, k] - stream[0, k]) ** 2
        push += acceleration[i, k] ** 2
    # Three lengths whose squares add up to a third of another's square add up to less than that: no roots for most.
    if WELL_WITHIN * (away + span * span * (quick + 0.25 * span * span * push)) <= reach[i] * reach[i]:
        return span
    room, speed, push = reach[i] - sqrt(away), sqrt(quick), sqrt(push)
    if (speed + 0.5 * push * span) * span <= room:
        return span
    if room <= 0.0:
        return 0.0
    return min(span, 2.0 * room / (speed + sqrt(speed * speed + 2.0 * push * room)))


@woven
def are_well_within(rows, n, span, stream, center, detected_center, reach, linear, acceleration):
    """Tell of eight rows from the n-th on, if they are in a row, that no body can leave its reach; most cannot."""
    if not in_a_row(rows, n):
        return False
    i = rows[n]
    x, y, z = load_three(address(center), i)
    dx, dy, dz = load_three(address(detected_center), i)
    vx, vy, vz = load_three(address(linear), i)
    ax, ay, az = load_three(address(acceleration), i)
    (room,) = load_one(address(reach), i)
    x, y, z = x - dx - spread(stream[1, 0]), y - dy - spread(stream[1, 1]), z - dz - spread(stream[1, 2])
    vx, vy, vz = vx - spread(stream[0, 0]), vy - spread(stream[0, 1]), vz - spread(stream[0, 2])
    away, quick, push = x * x + y * y + z * z, vx * vx + vy * vy + vz * vz, ax * ax + ay * ay + az * az
    return which(room * room - WELL_WITHIN * (away + span * span * (quick + 0.25 * span * span * push))) == ALL


@woven
def time_within_all(rows, span, stream, center, detected_center, reach, linear, acceleration):
    """Return for how long (s, at most ``span``) no body can leave its reach."""
    least = span
    for n in range(0, len(rows), WIDTH):
        if are_well_within(rows, n, span, stream, center, detected_center, reach, linear, acceleration):
            continue
        for k in range(n, min(n + WIDTH, len(rows))):
            within = time_within_reach(
                rows[k], span, 0.0, stream, center, detected_center, reach, linear, acceleration
            )  # fmt: skip
            least = min(least, within)
    return least


@kernel("leaving", within=True)
def find_leaving(rows, span, stream, center, detected_center, reach, linear, acceleration, leaving):
    """Write which bodies may leave their reach within ``span`` seconds, as many as there is room for; count them."""
    count = 0
    for n in range(0, len(rows), WIDTH):
        if are_well_within(rows, n, span, stream, center, detected_center, reach, linear, acceleration):
            continue
        for k in range(n, min(n + WIDTH, len(rows))):
            i = rows[k]
            if time_within_reach(
                i, span, 0.0, stream, center, detected_center, reach, linear, acceleration
            ) < span:  # fmt: skip
                leaving[count] = i
                count += 1
                if count == len(leaving):
                    return count
    return count


@kernel("reach", "detected_center")
def widen_reach(leaving, span, stream, center, linear, acceleration, reach, detected_center):
    """Give bodies the reach that they need for ``span`` seconds as they fly now.

    That is around where they are, which is told as where the stream has come from since detection.
    """
    for i in leaving:
        reach[i] = REACH_FACTOR * way_within(i, span, stream, linear, acceleration)
        for k in range(3):
            detected_center[i, k] = center[i, k] - stream[1, k]


@kernel("ways")
def find_ways(colliders, body_row, stream, center, detected_center, reach, ways):
    """Write how far (m) at most the bodies of colliders come, within their reach, from where they are now."""
    for c in colliders:
        i = body_row[c]
        if i >= 0:
            away = 0.0
            for k in range(3):
                away += (center[i, k] - detected_center[i, k] - stream[1, k]) ** 2
            ways[i] = reach[i] + sqrt(away)
