"""Flying on: all bodies along their arcs to the end of a substep, with looks on the way at those who are fast."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels.advancing import advance_bodies as advance
from carom.systems.kernels.closing import find_closing as close
from carom.systems.kernels.crew import ROOM, share
from carom.systems.kernels.crew_words import describe
from carom.systems.kernels.impacts import DONE, TO_LOOK
from carom.systems.kernels.impacts import fly as fly_pairs
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.left_out import when_near as come
from carom.systems.kernels.meeting import foresee_meetings
from carom.systems.kernels.reach import find_leaving
from carom.systems.kernels.settling import finish_drift, sink_contacts, tell_depths
from carom.systems.kernels.swinging import TRUSTED
from carom.systems.kernels.telling import ask_told
from carom.systems.kernels.told import let_astray_go as let_go
from carom.systems.kernels.told import renew_told
from carom.systems.kernels.trust import ask_straying as stray
from carom.systems.kernels.trust import spend_trust as spend

finish, foresee = finish_drift.within, foresee_meetings.within
sink, tell, leave = sink_contacts.within, tell_depths.within, find_leaving.within

TO_ASK, TO_DETECT = 3, 4  # why a flight ends, besides: somebody may meet whom nobody foresaw, or does
FOUND = -1.0  # when (s) to look next, where contacts have just been found


@kernel(
    "center", "start_center", "rotation", "turned", "linear", "angular", "time", "stream", "position",
    "stale", "lanes", "bodies", "closes", "normal", "depth", "offset_a", "offset_b", "resting", "impulse",
    "friction_impulse", "strikes", "plastic", "room", "asked", "near", "left", "times", "places", "struck", "arc",
    "log", "log_pair",
    makes_arrays=True, within=True,
)  # fmt: skip
def fly_on(
    for_rows, for_groups, for_closing, most_looks, at, events, looks, soon, h, bends, clock, gone, rows, watched, bound,
    center, start_center, rotation, turned, linear, angular, time, acceleration, angular_acceleration, felt,
    stream, detected_center, detected_rotation, reach, center_of_mass, inverse_mass, inertia, inverse_inertia,
    principal_axes, freedom, held, start_position, start_rotation, decay, angular_decay, flow, position,
    count, groups, solids, start, group_of, lane_of, index_a, index_b, first, size, points, row, fresh, stale, lanes,
    bodies, closes,
    body_a, body_b, normal, depth, point, offset_a, offset_b, share_of_b, row_a, row_b, shape, bound_radius, kind,
    ball, other, sign, radius, extent, other_position, other_rotation, surface, friction, restitution, resting,
    impulse, friction_impulse, strikes, plastic,
    fast, numbers, cores, roots, local_position, local_rotation, bounds, nodes, triangles, room, asked, near, left,
    times, before, angular_before, spans, around, places, far_bodies, far_normals, gaps, nears, far_places, trusts,
    struck, pull, arc, logged, log_pair, log,
):  # fmt: skip
    """Fly all bodies from ``at`` (s) to the end of a substep of h seconds, or to when somebody is to be detected.

    Who is fast is to be looked at in ``soon`` seconds, which is found out first where that is `FOUND`; as often as
    contacts in the table still tell where they meet they fly on, after so many ``looks``, of most, and ``events``. The
    step will have ``gone`` on for so long when the substep ends. Return ((why it ends, when, events, looks, soon, by
    how much looks are more if detection holds, whether anything has been since the last), cut, looks taken and given
    up, impacts logged, pair of each, log).
    """
    leaving, tells, trusted = np.empty(1, np.int64), np.empty(len(fast), np.bool_), numbers[:, TRUSTED]
    soonest = np.empty((len(for_closing) // ROOM, 2))
    cut, looked, given_up = 0, 0, 0
    while True:
        went, had, until = at, events, np.inf
        if soon < 0.0:
            # Planes of contacts stay, however bodies move.
            if stray(gone, h, fast, numbers, rotation, linear, angular, linear, asked, tells):
                let_go(
                    count, start, group_of, lane_of, row, body_a, body_b, normal, spans, around, places, trusted, tells,
                    near, center, rotation, linear, angular, depth, resting, lanes,
                )  # fmt: skip
            soon = look(
                h - at, True, center, rotation, linear, angular, felt, detected_center, detected_rotation, reach,
                fast, numbers, cores, roots, local_position, local_rotation, bounds, nodes, triangles, room,
                far_bodies, far_normals, gaps, nears, far_places, asked, near, left, times, struck,
            )  # fmt: skip
        if looks < most_looks:
            until = at + soon
        elif soon < np.inf:
            given_up += 1
        to, reason = h, DONE
        if count or len(watched) or until < h:
            begins = solids and at == 0.0
            within, some = ask_closing(
                for_closing, soonest, begins, h - at, count, groups, bound, watched, stream, center,
                detected_center, reach, linear, angular, acceleration, index_a, index_b, points, row, group_of, lane_of,
                start, kind, ball, other, other_position, other_rotation, radius, extent, restitution, resting, lanes,
                bodies, closes,
            )  # fmt: skip
            if at > 0.0 or some or h > min(within, until):
                if at == 0.0:
                    share(describe(tell, for_groups, (groups, first, size, row, kind, lanes, depth)))
                to, reason, events, passed, logged, log_pair, log = fly_pairs(
                    at, h, bends, clock, center, start_center, rotation, turned, linear, angular, time, acceleration,
                    angular_acceleration, felt, stream, detected_center, detected_rotation, reach, inverse_mass,
                    inertia, inverse_inertia, principal_axes, freedom, count, start, group_of, stale, body_a, body_b,
                    normal, depth, point, offset_a, offset_b, share_of_b, row_a, row_b, shape, bound_radius,
                    kind, ball, other, extent, radius, other_position, other_rotation, sign, surface, friction,
                    restitution, resting, impulse, friction_impulse, strikes, plastic, closes, within, held, until,
                    trusts, struck, events, pull, arc, logged, log_pair, log,
                )  # fmt: skip
                cut += passed
        share(describe(advance, for_rows, (
            rows, to, bends, center, rotation, turned, linear, angular, time, acceleration,
            angular_acceleration, inverse_mass, inertia, principal_axes, freedom, pull, arc,
        )))  # fmt: skip
        for axis in range(3):
            stream[1, axis] += stream[0, axis] * (to - at)
        at = to
        if reason == DONE:
            return (DONE, at, events, looks, soon, 0.0, True), cut, looked, given_up, logged, log_pair, log
        share(describe(finish, for_rows, (
            rows, False, h, inverse_mass, center_of_mass, freedom, start_position, start_rotation,
            decay, angular_decay, flow, rotation, center, linear, angular, position,
        )))  # fmt: skip
        goes_on, told, soon = at > went or events != had, False, np.inf
        if looks < most_looks:
            looked += 1
            spend(
                at - went, h, fast, numbers, center, rotation, linear, angular, before, angular_before, struck, left,
                times,
            )  # fmt: skip
            if stray(h - at, h, fast, numbers, rotation, linear, angular, before, asked, tells):
                let_go(
                    count, start, group_of, lane_of, row, body_a, body_b, normal, spans, around, places, trusted, tells,
                    near, center, rotation, linear, angular, depth, resting, lanes,
                )  # fmt: skip
            soon = look(
                h - at, False, center, rotation, linear, angular, felt, detected_center, detected_rotation,
                reach, fast, numbers, cores, roots, local_position, local_rotation, bounds, nodes, triangles, room,
                far_bodies, far_normals, gaps, nears, far_places, asked, near, left, times, struck,
            )  # fmt: skip
            told = soon == 0.0 and goes_on and ask_told(
                h - at, center, rotation, linear, angular, felt, fast, numbers, cores, roots, local_position,
                local_rotation, bounds, nodes, triangles, room, asked, times, body_a, body_b, normal, spans, around,
                places, left, tells,
            )  # fmt: skip
        elif reason == TO_LOOK:
            given_up += 1
        if told:
            share(describe(sink, for_groups, (
                groups, bound, start_center, center, turned, inverse_mass, inverse_inertia, principal_axes, freedom,
                rotation, index_a, index_b, points, row, fresh, bodies, lanes,
            )))  # fmt: skip
            share(describe(tell, for_groups, (groups, first, size, row, kind, lanes, depth)))
            renew_told(
                count, start, group_of, lane_of, row, stale, row_a, row_b, shape, bound_radius, body_a, body_b, normal,
                spans, around, places, trusted, tells, center, rotation, linear, angular, depth, offset_a, offset_b,
                resting, lanes,
            )  # fmt: skip
            begin_anew(rows, center, start_center, turned)
            soon = look(
                h - at, False, center, rotation, linear, angular, felt, detected_center, detected_rotation,
                reach, fast, numbers, cores, roots, local_position, local_rotation, bounds, nodes, triangles, room,
                far_bodies, far_normals, gaps, nears, far_places, asked, near, left, times, struck,
            )  # fmt: skip
        more = 1.0 if events == had else 0.0  # impacts end anyway
        if told:  # each pair at its own time
            more = 1.0 / len(fast)
        if not (soon > 0.0 and goes_on):
            ends = (TO_DETECT, at, events, looks + 1.0, soon, 0.0, goes_on)
            return ends, cut, looked, given_up, logged, log_pair, log
        if reason != TO_LOOK and leave(watched, h - at, stream, center, detected_center, reach, linear, felt, leaving):
            return (TO_ASK, at, events, looks, soon, more, True), cut, looked, given_up, logged, log_pair, log
        looks += more


@woven
def ask_closing(
    for_closing, soonest, solids, span, count, groups, bound, watched, stream, center, detected_center, reach,
    linear, angular, acceleration, index_a, index_b, points, row, group_of, lane_of, start, kind, ball, other,
    other_position, other_rotation, radius, extent, restitution, resting, lanes, bodies, closes,
):  # fmt: skip
    """Return how soon (s, at most ``span``) a body leaves its reach, and whether some manifolds may strike.

    Unless ``solids`` are asked, as when a substep begins, all of them may; each thread has a row of ``soonest``.
    """
    for part in range(len(soonest)):
        soonest[part, 0], soonest[part, 1] = span, 0.0
    share(describe(close, for_closing, (
        count, groups, solids, span, bound, watched, stream, center, detected_center, reach,
        linear, angular, acceleration, index_a, index_b, points, row, group_of, lane_of, start,
        kind, ball, other, other_position, other_rotation, radius, extent, restitution, resting, lanes, bodies,
        closes, soonest,
    )))  # fmt: skip
    within, some = span, False
    for part in range(len(soonest)):
        within, some = min(within, soonest[part, 0]), some or soonest[part, 1] > 0.0
    return within, some


@woven
def look(
    span, found, center, rotation, linear, angular, felt, detected_center, detected_rotation, reach,
    fast, numbers, cores, roots, local_position, local_rotation, bounds, nodes, triangles, room,
    far_bodies, far_normals, gaps, nears, far_places, asked, near, left, times, struck,
):  # fmt: skip
    """Return in how many seconds somebody is to be looked at as all move now; infinity beyond ``span``.

    Contacts have just been ``found``, or what was is trusted for as long as it lasts. In the former case only the first
    counts, most often there is none, and times of others stay unknown.
    """
    if not len(fast):
        return np.inf
    if found:
        times[:] = 0.0
    struck[:] = False
    soon = foresee(
        span, found, found, center, rotation, linear, angular, felt, detected_center, detected_rotation, reach,
        fast, numbers, cores, roots, local_position, local_rotation, bounds, nodes, triangles, room,
        asked, near, left, times,
    )  # fmt: skip
    if found:
        times[:] = 0.0
    soon = min(soon, come(span, far_bodies, far_normals, gaps, nears, far_places, center, rotation, linear, angular))
    return soon if soon < span else np.inf


@woven
def begin_anew(rows, center, start_center, turned):
    """Let bodies fly on from where they are: depths are those of now."""
    for i in rows:
        for axis in range(3):
            start_center[i, axis], turned[i, axis] = center[i, axis], 0.0
