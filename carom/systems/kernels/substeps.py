"""Substeps: what the systems of a substep do, one after the other, for as long as nobody has to be asked in between."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.systems.constants import BEARING_SWEEPS
from carom.systems.kernels.advancing import advance_bodies
from carom.systems.kernels.arcs import bend_arcs
from carom.systems.kernels.ball_touches import write_touches
from carom.systems.kernels.crew import ROOM, share
from carom.systems.kernels.crew_words import describe
from carom.systems.kernels.flight import predict_middle
from carom.systems.kernels.flying_on import FOUND, ask_closing, fly_on
from carom.systems.kernels.free_flight import fly_freely, is_free
from carom.systems.kernels.impacts import DONE
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.kicking import VERLET, kick_bodies
from carom.systems.kernels.packing import pack_bodies
from carom.systems.kernels.reach import find_leaving
from carom.systems.kernels.resting import press_groups
from carom.systems.kernels.settling import finish_drift, sink_contacts, tell_depths
from carom.systems.kernels.sorting import sort_groups
from carom.systems.kernels.ticks import nanoseconds
from carom.systems.yielding import HARD

predict, pack, sort, touch = predict_middle.within, pack_bodies.within, sort_groups.within, write_touches.within
kick, bend, soar = kick_bodies.within, bend_arcs.within, fly_on.within
finish, sink, tell, leave = finish_drift.within, sink_contacts.within, tell_depths.within, find_leaving.within

#: The systems whose work is done here, in the order of the frame.
LOOK_AHEAD, PREDICT, SORT, KICK, HOLD, DRIFT, SETTLE, RELAX, SYSTEMS = range(9)


@kernel(
    "fresh", "stale", "looks", "asks", "closes", "leans", "lanes", "bodies", "scratch", "stirred",
    "position", "rotation", "linear", "angular", "last_acceleration", "last_angular_acceleration",
    "center", "time", "acceleration", "angular_acceleration", "decay", "angular_decay", "flow", "touching",
    "start_position", "start_rotation", "start_linear", "start_angular", "start_center", "turned",
    "normal", "depth", "point", "offset_a", "offset_b", "resting", "impulse", "friction_impulse", "strikes", "plastic",
    "stream", "arc", "room", "asked", "near", "left", "times", "places", "struck", "log", "log_pair", "spent",
    makes_arrays=True,
)  # fmt: skip
def take_substeps(
    crew, alone, fewest, most_looks, number, substeps, h, begun, scheme, resting_stage, soft, rigid, relaxes,
    rows, watched, bound, contacts, count, groups, levels, solids, balls,
    start, beside, group_of, lane_of, index_a, index_b, first, size, points, row, fresh, stale, looks, asks, ends,
    run_ends, closes, leans, lanes, bodies, scratch, crushed, stirred,
    center_of_mass, inverse_mass, inertia, inverse_inertia, principal_axes, freedom, drag, drag_flow, angular_drag,
    position, rotation, linear, angular, last_acceleration, last_angular_acceleration,
    center, time, acceleration, angular_acceleration, felt, decay, angular_decay, flow, touching, held,
    start_position, start_rotation, start_linear, start_angular, start_center, turned,
    stream, detected_center, detected_rotation, reach,
    body_a, body_b, normal, depth, point, offset_a, offset_b, share_of_b,
    row_a, row_b, shape, bound_radius, kind, ball, other, sign, radius, extent,
    other_position, other_rotation, surface, friction, restitution, resting, impulse, friction_impulse,
    strikes, plastic, fast, numbers, cores, roots, local_position, local_rotation, bounds, nodes, triangles, room,
    asked, near, left, times, before, angular_before, spans, around, places, far_bodies, far_normals, gaps, nears,
    far_places, trusts, struck, pull, arc, log_pair, log, spent,
):  # fmt: skip
    """Go on from where substep ``number``, from 1 on, has its forces, until the step or the flight of a substep ends.

    Or before a substep in which somebody may leave what detection foresaw. Return (the last substep begun, its flight,
    how many manifolds rested in it, cut, looks taken and given up, impacts logged, pair of each, log), as `fly_on`.

    Forces are those of the first substep, and there are no joints and no sensors. Manifolds are swept so often
    (``relaxes``) after each drift. What is done for each of `SYSTEMS` is what that does; ``spent`` is how long it took
    (ns).
    """
    for_rows = crew if len(rows) >= fewest else alone  # as `crew_for` does
    for_bound = crew if len(bound) >= fewest else alone
    for_groups = crew if count >= fewest else alone
    for_closing = crew if max(count, len(watched)) >= fewest else alone
    none = logged = np.int64(0)  # a bare 0 has a type of its own, for which `fly_on` would be compiled once more
    bends, leaving = 0.5 if scheme == VERLET else 0.0, np.empty(1, np.int64)
    apart, rests, rest = np.zeros(len(crew) // ROOM, np.bool_), np.zeros(len(crew) // ROOM, np.int64), 0
    cut, looked, given_up = 0, 0, 0
    begins, flown, flight = number, True, (DONE, h, none, 0.0, FOUND, 0.0, True)
    stirs, soonest = np.empty((2, len(crew) // ROOM), np.bool_), np.empty((len(crew) // ROOM, 2))
    joined = np.empty(0, np.int64)  # nobody is
    now = nanoseconds()
    if not (count or len(fast)) and is_free(
        rows, watched, (substeps - number + 1) * h, drag, stream, center, detected_center, reach, linear, felt
    ):
        share(describe(fly_freely, for_rows, (
            rows, number, substeps, h, scheme, bends, center_of_mass, inverse_mass, inertia, principal_axes, freedom,
            drag, drag_flow, angular_drag, position, rotation, linear, angular, last_acceleration,
            last_angular_acceleration, center, time, acceleration, angular_acceleration, felt, decay, angular_decay,
            flow, touching, held, start_position, start_rotation, start_linear, start_angular, start_center, turned,
            pull, arc,
        )))  # fmt: skip
        for _ in range(number, substeps + 1):
            for axis in range(3):
                stream[1, axis] += stream[0, axis] * h
        note(DRIFT, now, spent)
        return substeps, flight, rest, cut, looked, given_up, logged, log_pair, log
    for k in range(number, substeps + 1):
        clock = begun + (k - 1) * h
        if k > begins:
            leaves = leave(watched, h, stream, center, detected_center, reach, linear, felt, leaving)
            now = note(LOOK_AHEAD, now, spent)
            if leaves:
                return k - 1, flight, rest, cut, looked, given_up, logged, log_pair, log
            share(describe(predict, for_rows, (
                rows, 0.0, center_of_mass, freedom, held, last_acceleration,
                last_angular_acceleration, position, rotation, linear, angular, center, start_center, start_position,
                start_rotation, start_linear, start_angular, angular_acceleration, time, turned, touching,
            )))  # fmt: skip
            now = note(PREDICT, now, spent)
        rest = 0
        if groups:
            share(describe(pack, for_bound, (
                bound, k == number, center_of_mass, center, linear, angular, felt, inverse_mass,
                inverse_inertia, principal_axes, freedom, rotation, bodies, apart,
            )))  # fmt: skip
            clear(leans)
            share(describe(sort, for_groups, (
                groups, h, scheme == VERLET, resting_stage, False, ends, index_a, index_b, first,
                size, points, row, fresh, stale, looks, asks, lanes, bodies, center, rotation,
                kind, ball, other, sign, radius, extent, other_position, other_rotation, body_a, body_b, normal,
                depth, point, offset_a, offset_b, resting, strikes, beside, held, touching, leans, rests,
            )))  # fmt: skip
            rest = total(rests)
            if balls and k == substeps:
                share(describe(touch, for_groups, (
                    contacts, kind, sign, radius, extent, body_a, body_b, inverse_mass, center,
                    normal, depth, point, offset_a, offset_b,
                )))  # fmt: skip
            now = note(SORT, now, spent)
        share(describe(kick, for_rows, (
            rows, h, scheme, inverse_mass, freedom, drag, drag_flow, angular_drag, felt, touching,
            linear, angular, acceleration, angular_acceleration, decay, angular_decay, flow,
            last_acceleration, last_angular_acceleration,
        )))  # fmt: skip
        now = note(KICK, now, spent)
        if rest:
            share(describe(press_groups, for_groups, (
                True, 0, 1 + BEARING_SWEEPS, 1, False, h, ends, levels, run_ends, soft, rigid, index_a, index_b, points,
                row, asks, bound, scratch, lanes, bodies, linear, angular, crushed, joined, stirred, stirs,
            )))  # fmt: skip
            if scheme == VERLET and some_lean(leans):
                share(describe(bend, for_groups, (
                    h, bound, leans, levels, run_ends, index_a, index_b, row, asks, lanes, bodies,
                    start_linear, start_angular, linear, angular, acceleration, angular_acceleration,
                )))  # fmt: skip
            now = note(HOLD, now, spent)
        for c in range(contacts if flown else 0):
            strikes[c] = plastic[c] = 0
        within, some = h, len(fast) > 0
        if not some and (count or len(watched)):
            within, some = ask_closing(
                for_closing, soonest, solids, h, count, groups, bound, watched, stream, center,
                detected_center, reach, linear, angular, acceleration, index_a, index_b, points, row, group_of, lane_of,
                start, kind, ball, other, other_position, other_rotation, radius, extent, restitution, resting, lanes,
                bodies, closes,
            )  # fmt: skip
        flown = some or within < h
        if flown:
            flight, passed, taken, gave_up, logged, log_pair, log = soar(
                for_rows, for_groups, for_closing, most_looks, 0.0, none, 0.0, FOUND, h, bends, clock, k * h,
                rows, watched, bound, center, start_center, rotation, turned, linear, angular, time, acceleration,
                angular_acceleration, felt, stream, detected_center, detected_rotation, reach, center_of_mass,
                inverse_mass, inertia, inverse_inertia, principal_axes, freedom, held, start_position, start_rotation,
                decay, angular_decay, flow, position, count, groups, solids, start, group_of, lane_of, index_a, index_b,
                first, size, points, row, fresh, stale, lanes, bodies, closes, body_a, body_b, normal, depth, point,
                offset_a, offset_b, share_of_b, row_a, row_b, shape, bound_radius, kind, ball, other, sign, radius,
                extent, other_position, other_rotation, surface, friction, restitution, resting, impulse,
                friction_impulse, strikes, plastic, fast, numbers, cores, roots, local_position, local_rotation, bounds,
                nodes, triangles, room, asked, near, left, times, before, angular_before, spans, around, places,
                far_bodies, far_normals, gaps, nears, far_places, trusts, struck, pull, arc, logged, log_pair, log,
            )  # fmt: skip
            cut, looked, given_up = cut + passed, looked + taken, given_up + gave_up
        else:  # most often, and it takes a quarter of the time
            share(describe(advance_bodies, for_rows, (
                rows, h, bends, center, rotation, turned, linear, angular, time, acceleration,
                angular_acceleration, inverse_mass, inertia, principal_axes, freedom, pull, arc,
            )))  # fmt: skip
            for axis in range(3):
                stream[1, axis] += stream[0, axis] * h
        now = note(DRIFT, now, spent)
        if flight[0] != DONE:
            return k, flight, rest, cut, looked, given_up, logged, log_pair, log
        share(describe(finish, for_rows, (
            rows, True, h, inverse_mass, center_of_mass, freedom, start_position, start_rotation,
            decay, angular_decay, flow, rotation, center, linear, angular, position,
        )))  # fmt: skip
        if groups:
            share(describe(sink, for_groups, (
                groups, bound, start_center, center, turned, inverse_mass, inverse_inertia, principal_axes, freedom,
                rotation, index_a, index_b, points, row, fresh, bodies, lanes,
            )))  # fmt: skip
            if k == substeps:
                share(describe(tell, for_groups, (groups, first, size, row, kind, lanes, depth)))
        now = note(SETTLE, now, spent)
        if rest:
            share(describe(press_groups, for_groups, (
                False, 0, relaxes + BEARING_SWEEPS, relaxes, True, h, ends, levels, run_ends, HARD, HARD,
                index_a, index_b, points, row, asks, bound, scratch, lanes, bodies, linear, angular,
                crushed, joined, stirred, stirs,
            )))  # fmt: skip
            now = note(RELAX, now, spent)
    return substeps, flight, rest, cut, looked, given_up, logged, log_pair, log


@woven
def clear(leans):
    """Let nobody lean on anybody."""
    for side in range(2):
        for i in range(leans.shape[1]):
            leans[side, i] = False


@woven
def total(numbers):
    """Return the sum of what threads have counted; they begin with 0 again."""
    found = 0
    for part in range(len(numbers)):
        found += numbers[part]
        numbers[part] = 0
    return found


@woven
def some_lean(leans):
    """Tell whether somebody rests on something as balls on exact arcs do."""
    found = False
    for i in range(leans.shape[1]):
        found |= leans[1, i]
    return found


@woven
def note(system, since, spent):
    """Add the time since then to that of a system; return the time."""
    now = nanoseconds()
    spent[system] += now - since
    return now
