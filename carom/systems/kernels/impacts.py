"""Impacts: bodies fly along their arcs to the end of the substep, reflected at the exact time of every impact."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import IMPACTS_AT_LEAST, IMPACTS_PER_PAIR, PATIENCE
from carom.systems.kernels.balls import NEVER
from carom.systems.kernels.bodies import advance_body
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.strikes import foresee, strike

DONE, OUT_OF_REACH, TABLE_FULL = 0, 1, 2


@kernel(
    "center", "rotation", "linear", "angular", "time", "acceleration", "resting", "impulse", "friction_impulse",
    "log_time", "log_pair", "log_point", "log_normal", "log_speed", "log_impulse", "log_friction",
)  # fmt: skip
def fly(
    rows, start, h, left, bend, clock,
    center, rotation, linear, angular, time, acceleration, angular_acceleration, felt, detected_center, reach,
    inverse_mass, inertia, inverse_inertia, principal_axes,
    kind, ball, other, extent, radius, other_position, other_rotation, sign,
    friction, restitution, resting, impulse, friction_impulse,
    log_count, events, log_time, log_pair, log_point, log_normal, log_speed, log_impulse, log_friction,
):  # fmt: skip
    """Fly all bodies from ``start`` to ``h`` (s) into the substep; return (time reached, impacts logged, reason, cut).

    ``left`` is the time from the substep's end to the step's. Pairs are rows of the contact table with ``kind`` >= 0;
    their first body is the ball. Where a body comes to move faster than its detection foresaw, or the log is full,
    everything is brought to that instant and the reason returned; the caller detects anew, or grows the log, and calls
    again, with the ``events`` of this substep so far. ``cut`` counts impacts beyond the cap, which are let pass.
    """
    pairs = np.nonzero(kind >= 0)[0]
    most = IMPACTS_AT_LEAST + IMPACTS_PER_PAIR * len(pairs)

    # Which pairs each body takes part in, as slices of one array.
    begin = np.zeros(len(inverse_mass) + 1, np.int64)
    for p in pairs:
        begin[ball[p] + 1] += 1
        if other[p] >= 0:
            begin[other[p] + 1] += 1
    for i in range(1, len(begin)):
        begin[i] += begin[i - 1]
    place = begin.copy()
    of_body = np.empty(begin[-1], np.int64)
    for m in range(len(pairs)):
        for body in (ball[pairs[m]], other[pairs[m]]):
            if body >= 0:
                of_body[place[body]] = m
                place[body] += 1

    # A tournament of the foreseen times: node k is the sooner of 2k and 2k + 1, the leaves are the pairs.
    leaves = 1
    while leaves < len(pairs):
        leaves *= 2
    soonest = np.full(2 * leaves, NEVER)
    seek = np.empty(2 * len(pairs) + 2, np.int64)
    seek_count = len(pairs)
    for m in range(seek_count):
        seek[m] = m
    strikes, plastic = np.zeros(len(pairs), np.int64), np.zeros(len(pairs), np.int64)
    now, cut = start, 0
    reason = DONE
    first = True
    while True:
        # Foresee the next impact of every pair whose bodies changed course.
        for index in range(seek_count):
            m = seek[index]
            p = pairs[m]
            foreseen = foresee(
                p, ball[p], other[p], now, h, (not first or start > 0.0) and plastic[m] < PATIENCE, bend,
                center, rotation, linear, angular, time, acceleration, felt,
                kind, radius, extent, other_position, other_rotation, resting,
            )  # fmt: skip
            enter_time(soonest, leaves + m, foreseen)
        first = False
        seek_count = 0

        # The soonest of all: down the tournament to its leaf.
        if soonest[1] > h:
            now = h
            break
        m = 1
        while m < leaves:
            m *= 2
            if soonest[m] > soonest[m + 1]:
                m += 1
        now = max(now, soonest[m])
        m -= leaves
        p = pairs[m]
        if events >= most:
            cut += 1
            now = h
            break
        if log_count == len(log_time):
            reason = TABLE_FULL
            break
        i, o = ball[p], other[p]
        for body in (i, o):
            if body >= 0 and time[body] < now:
                advance_body(
                    body, now, bend, center, rotation, linear, angular, time, acceleration, angular_acceleration,
                    inertia, principal_axes,
                )  # fmt: skip
        speed, normal, nx, ny, nz, px, py, pz, jx, jy, jz, together = strike(
            p, i, o, h, strikes[m], center, rotation, linear, angular, acceleration, felt,
            inverse_mass, inverse_inertia, principal_axes,
            kind, radius, extent, other_position, other_rotation, friction, restitution,
        )  # fmt: skip
        enter_time(soonest, leaves + m, NEVER)
        resting[p] = together  # from now on only a blow makes it an impact, else plastic pairs would never end
        plastic[m] += together
        strikes[m] += 1
        events += 1
        if speed > 0.0:
            impulse[p] += normal
            log_time[log_count] = clock + now
            log_pair[log_count] = p
            log_speed[log_count] = speed
            log_impulse[log_count] = normal
            # The ball is a where sign is 1: the normal from a to b points away from it, and b feels the reaction.
            for k, (j, n, at) in enumerate(((jx, nx, px), (jy, ny, py), (jz, nz, pz))):
                rubbing = -sign[p] * (j - normal * n)
                friction_impulse[p, k] += rubbing
                log_friction[log_count, k] = rubbing
                log_normal[log_count, k] = -sign[p] * n
                log_point[log_count, k] = at
            log_count += 1

        # Both bodies are on new arcs: foresee all their pairs anew, and see whether detection still covers them.
        for body in (i, o):
            if body < 0:
                continue
            for slot in range(begin[body], begin[body + 1]):
                if of_body[slot] != m or (body == i and not together):
                    seek[seek_count] = of_body[slot]
                    seek_count += 1
            away, quick, push = 0.0, 0.0, 0.0
            for k in range(3):
                away += (center[body, k] - detected_center[body, k]) ** 2
                quick += linear[body, k] ** 2
                push += felt[body, k] ** 2
            until = h - now + left
            if sqrt(away) + (sqrt(quick) + 0.5 * sqrt(push) * until) * until > reach[body]:
                reason = OUT_OF_REACH
        if reason == OUT_OF_REACH:
            break
    for i in rows:
        if time[i] < now:
            advance_body(
                i, now, bend, center, rotation, linear, angular, time, acceleration, angular_acceleration,
                inertia, principal_axes,
            )  # fmt: skip
    return now, log_count, reason, cut


@inlined
def enter_time(soonest, leaf, time):
    """Set a leaf of the tournament and play the games above it again."""
    soonest[leaf] = time
    while leaf > 1:
        leaf //= 2
        soonest[leaf] = min(soonest[2 * leaf], soonest[2 * leaf + 1])
