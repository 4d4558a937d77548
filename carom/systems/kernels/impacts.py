"""Impacts: bodies fly along their arcs to the end of the substep, reflected at the exact time of every impact."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import (
    APPROACH,
    BLOW_SPEED_FACTOR,
    IMPACTS_AT_LEAST,
    IMPACTS_PER_PAIR,
    MEET,
    REST_SPEED_FACTOR,
)
from carom.systems.kernels.accounting import KEPT, keep_arc, kinetic_energy, note_arc
from carom.systems.kernels.balls import NEVER
from carom.systems.kernels.blow_points import place_points
from carom.systems.kernels.blows import blow, foresee_blow
from carom.systems.kernels.bodies import advance_body, is_on_joint
from carom.systems.kernels.bouncing import patience_of, pushed
from carom.systems.kernels.closing import HELD, HELD_BALL, MAY
from carom.systems.kernels.heaviness import is_heavy, least_gap, sink_allowed
from carom.systems.kernels.kernel import making, woven
from carom.systems.kernels.reach import time_within_reach
from carom.systems.kernels.strikes import foresee, strike
from carom.systems.kernels.tournament import enter_time, pairs_of_bodies
from carom.systems.kernels.trust import coming_of

DONE, OUT_OF_REACH, TO_LOOK = 0, 1, 2  # why a flight ends
FEW_IMPACTS = 64  # a flight has room for at first
# A row of the log: time, speed, impulse, work, and where the three vectors of 3 begin.
TIME, SPEED, IMPULSE, WORK, POINT, NORMAL, FRICTION, WIDTH = 0, 1, 2, 3, 4, 7, 10, 13


@making
def fly(
    start, h, bend, clock,
    center, start_center, rotation, turned, linear, angular, time, acceleration, angular_acceleration,
    felt, stream, detected_center, detected_rotation, reach,
    inverse_mass, inertia, inverse_inertia, principal_axes, freedom,
    count, beginning, group_of, stale, body_a, body_b, normal, depth, point, offset_a, offset_b, share,
    row_a, row_b, shape, bound_radius, kind, ball, other, extent, radius, other_position, other_rotation, sign,
    surface, friction, restitution, resting, impulse, friction_impulse, strikes, plastic, closing, within,
    on_joint, until, trusts, struck, events, pull, arc, log_count, log_pair, log,
):  # fmt: skip
    """Fly all bodies from ``start`` to ``h`` (s) into the substep and log their impacts after those ``log_count``.

    Returns (time reached, reason, events, cut, impacts logged, pair of each, log). Pairs are the ``count`` manifolds
    that begin at rows of the contact table: those of ``kind`` >= 0 are of a ball on an exact arc (`strike`), the others
    strike with all their points at once (`blow`), placed where they are by now for who may (`place_points`). As bodies
    move at first, ``closing`` says which may strike, and ``within`` how long nobody leaves his reach.
    Where a body comes to move faster than its detection foresaw, the flight goes on for as long as none can have left
    its reach; the caller brings all bodies to the time reached, detects anew and calls again. What the substep has
    counted so far goes on: ``events``, and for each pair ``strikes`` and ``plastic``, else to detect in the middle
    would renew the patience with endless rows of impacts. ``cut`` counts impacts beyond the cap, which are let pass.
    Nobody flies on beyond ``until``; nor, after an impact of a body that comes farther in the substep than what is
    known of its contacts is trusted, beyond when it may have come so near to others that they are to be looked at:
    ``trusts`` say when (`find_trusts`), and who goes another way since is ``struck``. Groups become ``stale`` in which
    pairs are struck, or no longer rest. Blows that go to and fro between bodies that stay together are at one time, and
    logged as one impact of each pair. An ``arc`` of more than no rows is accounted for (`note_arc`).
    """
    pairs, number = np.empty(count, np.int64), np.empty(count, np.int64)
    taken, near = 0, 0
    for m in range(count):
        near += closing[m] != HELD
        pairs[taken], number[taken] = beginning[m], m
        taken += closing[m] < HELD_BALL

    kept = np.empty((1, KEPT))
    now, end, cut, veers = start, min(h, until), 0, False
    end = min(end, now + within)
    if not taken and start == 0.0:
        return end, reason_of(end, h, until, veers), events, cut, log_count, log_pair, log

    seek = np.empty(2 * count + 2, np.int64)
    seek_count, heavy = 0, False
    for m in range(taken):
        p = pairs[m]
        if closing[number[m]] == MAY:
            seek[seek_count] = m
            seek_count += 1
            gap = least_gap(
                p, beginning[number[m] + 1], start, kind, ball, other, center, other_position, radius, extent, depth
            )
            heavy |= is_heavy(
                p, gap, body_a, body_b, h - now, kind, ball, other, center, normal, offset_a, offset_b,
                linear, angular, inertia, inverse_mass,
            )  # fmt: skip
    for m in range(count if start > 0.0 else 0):  # blows of before
        heavy |= closing[m] >= HELD_BALL and is_heavy(
            beginning[m], 0.0, body_a, body_b, h - now, kind, ball, other, center, normal, offset_a, offset_b,
            linear, angular, inertia, inverse_mass,
        )  # fmt: skip
    # Only then may those who rest be driven into each other: else they are not asked.
    for m in range(count if heavy else 0):
        if closing[m] < HELD_BALL:
            continue
        pairs[taken], number[taken] = beginning[m], m
        if start > 0.0:
            seek[seek_count] = taken
            seek_count += 1
        taken += 1
    pairs, placed = pairs[:taken], np.zeros(taken, np.bool_)
    points = beginning[count]
    at_a, at_b, deep = np.empty((points, 3)), np.empty((points, 3)), np.empty(points)  # of who may strike
    most = IMPACTS_AT_LEAST + IMPACTS_PER_PAIR * max(near, taken)

    # A tournament of the foreseen times: node k is the sooner of 2k and 2k + 1, the leaves are the pairs.
    leaves = 1
    while leaves < taken:
        leaves *= 2
    soonest = np.full(2 * leaves, NEVER)
    begin, of_body, logged = seek, seek, seek  # found before the first impact
    first = True
    while True:
        # Foresee the next impact of every pair whose bodies changed course.
        for index in range(seek_count):
            m = seek[index]
            p = pairs[m]
            springs = restitution[p] > 0.0
            left = plastic[p] >= patience_of(p, body_a, body_b, inverse_mass)
            if resting[p] and (left or (first and start == 0.0)):
                enter_time(soonest, leaves + m, NEVER)
                continue
            slow, sink = 0.0, 0.0
            if springs:
                factor = REST_SPEED_FACTOR if kind[p] < 0 else BLOW_SPEED_FACTOR
                slow = APPROACH + factor * h * pushed(body_a[p], body_b[p], felt)
            else:
                sink = sink_allowed(p, body_a, body_b, inertia, inverse_mass)
            if kind[p] < 0:
                if not placed[m]:
                    placed[m] = True
                    place_points(
                        p, beginning[number[m] + 1], body_a[p], body_b[p], row_a, row_b, shape,
                        bound_radius, normal, depth, point, offset_a, offset_b, share, start_center, rotation, turned,
                        detected_rotation, at_a, at_b, deep,
                    )  # fmt: skip
                foreseen = foresee_blow(
                    p, beginning[number[m] + 1], now, h, slow, sink, strikes[p] > 0, bend, center, linear, angular,
                    time, acceleration, body_a, body_b, normal, deep, at_a, at_b, start_center, turned, resting,
                )  # fmt: skip
                enter_time(soonest, leaves + m, foreseen)
                continue
            limit = slow if springs else sink / (h - now) if now < h else NEVER
            rested, joined = resting[p], is_on_joint(body_a[p], on_joint) or is_on_joint(body_b[p], on_joint)
            foreseen = foresee(
                p, ball[p], other[p], now, h, limit, bend,
                center, rotation, linear, angular, time, acceleration,
                kind, radius, extent, other_position, other_rotation, resting, joined,
            )  # fmt: skip
            stale[group_of[number[m]]] |= rested and not resting[p]
            enter_time(soonest, leaves + m, foreseen)
        seek_count = 0

        # The soonest of all: down the tournament to its leaf.
        if soonest[1] > end:
            now = end
            break
        if first:
            begin, of_body = pairs_of_bodies(pairs, body_a, body_b, len(inverse_mass))
            logged = np.full(taken, -1)  # where each pair's last impact is
            first = False
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
            now = end = h
            break
        i, o = body_a[p], body_b[p]
        if kind[p] >= 0:
            i, o = ball[p], other[p]
        for body in (i, o):
            if body >= 0 and time[body] < now:
                t = now - time[body]
                if len(arc):
                    keep_arc(body, 0, kept, center, linear, angular, rotation)
                advance_body(
                    body, now, bend, center, rotation, turned, linear, angular, time, acceleration,
                    angular_acceleration, inverse_mass, inertia, principal_axes, freedom,
                )  # fmt: skip
                if len(arc):
                    note_arc(
                        body, 0, t, bend, kept, center, rotation, linear, angular, acceleration, angular_acceleration,
                        inverse_mass, inertia, principal_axes, pull, arc,
                    )  # fmt: skip
        work = -kinetic_energy(i, linear, angular, rotation, inverse_mass, inertia, principal_axes)
        work -= kinetic_energy(o, linear, angular, rotation, inverse_mass, inertia, principal_axes)
        along_a = -1.0 if kind[p] < 0 else -sign[p]  # of the normal and the friction below, which act on the first
        if kind[p] < 0:
            nx, ny, nz = -normal[p, 0], -normal[p, 1], -normal[p, 2]
            speed, pressed, px, py, pz, fx, fy, fz, together = blow(
                p, beginning[number[m] + 1], h, strikes[p], center, rotation, linear, angular, acceleration, felt,
                inverse_mass, inverse_inertia, principal_axes, freedom,
                body_a, body_b, row_a, row_b, shape, bound_radius, normal, offset_a, offset_b, deep, at_a, at_b,
                start_center, turned, detected_rotation, share, surface, friction, restitution, impulse,
                friction_impulse,
            )  # fmt: skip
            fx, fy, fz = -fx, -fy, -fz
            at = i if i >= 0 else o
            px, py, pz = center[at, 0] + px, center[at, 1] + py, center[at, 2] + pz
        else:
            speed, pressed, nx, ny, nz, px, py, pz, jx, jy, jz, together = strike(
                p, i, o, h, strikes[p], center, rotation, linear, angular, acceleration, felt,
                inverse_mass, inverse_inertia, principal_axes, freedom,
                kind, radius, extent, other_position, other_rotation, sign, surface, friction, restitution,
            )  # fmt: skip
            fx, fy, fz = jx - pressed * nx, jy - pressed * ny, jz - pressed * nz
            impulse[p] += pressed
            for k, f in enumerate((fx, fy, fz)):
                friction_impulse[p, k] += along_a * f
        enter_time(soonest, leaves + m, NEVER)
        stale[group_of[number[m]]] = True
        for c in range(p, beginning[number[m] + 1]):
            resting[c] = together  # from now on only a blow makes it an impact, else plastic pairs would never end
        row = logged[m]
        again = row >= 0 and plastic[p] > 0 and log[row, TIME] == clock + now
        plastic[p] += together
        strikes[p] += 1
        events += 1
        if speed > 0.0:
            work += kinetic_energy(i, linear, angular, rotation, inverse_mass, inertia, principal_axes)
            work += kinetic_energy(o, linear, angular, rotation, inverse_mass, inertia, principal_axes)
        if speed > 0.0 and again:
            log[row, SPEED], log[row, IMPULSE] = max(log[row, SPEED], speed), log[row, IMPULSE] + pressed
            log[row, WORK] += work
            for k, f in enumerate((fx, fy, fz)):
                log[row, FRICTION + k] += along_a * f
        elif speed > 0.0:
            if log_count == len(log_pair):  # it grows: to stop where it is full would make bits depend on its room
                longer, longer_pair = np.empty((2 * log_count, WIDTH)), np.empty(2 * log_count, np.int64)
                for k in range(log_count):  # one by one: slices take seconds to compile, for what is said of shapes
                    longer_pair[k] = log_pair[k]
                    for part in range(WIDTH):
                        longer[k, part] = log[k, part]
                log, log_pair = longer, longer_pair
            log_pair[log_count], logged[m] = p, log_count
            log[log_count, TIME], log[log_count, SPEED], log[log_count, IMPULSE] = clock + now, speed, pressed
            log[log_count, WORK] = work
            # The normal from a to b points away from a ball that is a, and b feels the reaction.
            for k, (f, n, at_k) in enumerate(((fx, nx, px), (fy, ny, py), (fz, nz, pz))):
                log[log_count, FRICTION + k] = along_a * f
                log[log_count, NORMAL + k] = along_a * n
                log[log_count, POINT + k] = at_k
            log_count += 1

        # Who can be pushed is on a new arc: foresee all its pairs anew, and see whether detection still covers it.
        first_pushed = i if i >= 0 and inverse_mass[i] > 0.0 else o
        for body in (i, o):
            if body < 0 or inverse_mass[body] == 0.0:
                continue
            struck[body] = True
            for slot in range(begin[body], begin[body + 1]):
                comes = kind[p] < 0 or not together  # points that did not touch yet are still to come
                if of_body[slot] != m or (comes and body == first_pushed):
                    seek[seek_count] = of_body[slot]
                    seek_count += 1
            within = time_within_reach(
                body, h - now, now - start, stream, center, detected_center, reach, linear, acceleration
            )  # fmt: skip
            if within < h - now:
                end = min(end, now + within)
            quick = coming_of(body, rotation, linear, angular, trusts)
            if quick * (h - now) > trusts[body, 0]:
                end, veers = min(end, now + MEET * trusts[body, 0] / quick), True
    return now, reason_of(now, h, until, veers), events, cut, log_count, log_pair, log


@woven
def reason_of(now, h, until, veers):
    """Return why a flight of h seconds ends at ``now``: to look at who is fast, or ``veers`` off, goes before reach."""
    if now >= h:
        return DONE
    return TO_LOOK if veers or now >= until else OUT_OF_REACH
