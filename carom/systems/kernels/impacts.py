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

DONE, OUT_OF_REACH = 0, 1

# A row of the log: time, speed, impulse, and where the three vectors of 3 begin.
TIME, SPEED, IMPULSE, POINT, NORMAL, FRICTION, WIDTH = 0, 1, 2, 3, 6, 9, 12


@kernel(
    "center", "rotation", "linear", "angular", "time", "acceleration", "resting", "impulse", "friction_impulse",
    "strikes", "plastic",
)  # fmt: skip
def fly(
    rows, start, h, left, bend, clock,
    center, rotation, linear, angular, time, acceleration, angular_acceleration, felt, detected_center, reach,
    inverse_mass, inertia, inverse_inertia, principal_axes,
    kind, ball, other, extent, radius, other_position, other_rotation, sign,
    friction, restitution, resting, impulse, friction_impulse, strikes, plastic, events,
):  # fmt: skip
    """Fly all bodies from ``start`` to ``h`` (s) into the substep and log their impacts.

    Returns (time reached, reason, events, cut, impacts logged, pair of each, log). ``left`` is the time from the
    substep's end to the step's. Pairs are rows of the contact table with ``kind`` >= 0; their first body is the ball.
    Where a body comes to move faster than its detection foresaw, everything is brought to that instant; the caller
    detects anew and calls again. What the substep has counted so far goes on: ``events``, and for each pair
    ``strikes`` and ``plastic``, else detection in the middle would renew the patience with endless rows of impacts.
    ``cut`` counts impacts beyond the cap, which are let pass.
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
    # The log grows here: to stop where a table of the caller's is full would make bits depend on its capacity.
    log, log_pair, log_count = np.empty((64, WIDTH)), np.empty(64, np.int64), 0
    now, cut = start, 0
    reason = DONE
    first = True
    while True:
        # Foresee the next impact of every pair whose bodies changed course.
        for index in range(seek_count):
            m = seek[index]
            p = pairs[m]
            foreseen = foresee(
                p, ball[p], other[p], now, h, (not first or start > 0.0) and plastic[p] < PATIENCE, bend,
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
        i, o = ball[p], other[p]
        for body in (i, o):
            if body >= 0 and time[body] < now:
                advance_body(
                    body, now, bend, center, rotation, linear, angular, time, acceleration, angular_acceleration,
                    inertia, principal_axes,
                )  # fmt: skip
        speed, normal, nx, ny, nz, px, py, pz, jx, jy, jz, together = strike(
            p, i, o, h, strikes[p], center, rotation, linear, angular, acceleration, felt,
            inverse_mass, inverse_inertia, principal_axes,
            kind, radius, extent, other_position, other_rotation, friction, restitution,
        )  # fmt: skip
        enter_time(soonest, leaves + m, NEVER)
        resting[p] = together  # from now on only a blow makes it an impact, else plastic pairs would never end
        plastic[p] += together
        strikes[p] += 1
        events += 1
        if speed > 0.0:
            impulse[p] += normal
            if log_count == len(log_pair):
                longer, longer_pair = np.empty((2 * log_count, WIDTH)), np.empty(2 * log_count, np.int64)
                longer[:log_count], longer_pair[:log_count] = log, log_pair
                log, log_pair = longer, longer_pair
            log_pair[log_count] = p
            log[log_count, TIME], log[log_count, SPEED], log[log_count, IMPULSE] = clock + now, speed, normal
            # The ball is a where sign is 1: the normal from a to b points away from it, and b feels the reaction.
            for k, (j, n, at) in enumerate(((jx, nx, px), (jy, ny, py), (jz, nz, pz))):
                rubbing = -sign[p] * (j - normal * n)
                friction_impulse[p, k] += rubbing
                log[log_count, FRICTION + k] = rubbing
                log[log_count, NORMAL + k] = -sign[p] * n
                log[log_count, POINT + k] = at
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
    return now, reason, events, cut, log_count, log_pair, log


@inlined
def enter_time(soonest, leaf, time):
    """Set a leaf of the tournament and play the games above it again."""
    soonest[leaf] = time
    while leaf > 1:
        leaf //= 2
        soonest[leaf] = min(soonest[2 * leaf], soonest[2 * leaf + 1])
