"""Sinking: how deep the points of manifolds come to be as bodies go on, and where they are by then."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import TURNED
from carom.systems.kernels import groups as of
from carom.systems.kernels.going_along import turn_of_face
from carom.systems.kernels.groups import ABSENT, MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import dot, keep, minus, plus, swung, three, times, where
from carom.systems.kernels.lanes import choose, larger, load, root, some, spread, store
from carom.systems.kernels.levers import frame_of, parting_at, parting_of, seen_from
from carom.systems.kernels.rounds_in_lanes import turn_between


@woven
def sink_points(r, points, fresh, lanes, a, b):
    """Write how deep the points of a group have come to be as its bodies went on their ways, and where they are by now.

    A point goes with both bodies, to first order of their turn, with what is round to second order; then it goes on in
    its frame, which stays, or goes on with the face or round the other (`set_out`): what turns as that does stays in
    it. The middle goes with either body, as it does where nothing slips, and with what is round over the face of the
    other (`rolled_over`); points turn about it with whose corners they are: of neither, or of both, half as much
    (`goes_with_b`). Those of what is round go with its axis, which leans as they are deep. What else is smooth turns
    beneath its points; `roll_on` says where those go.
    """
    zero, turn_a, turn_b = spread(0.0), a[4:7], b[4:7]
    parting = parting_of(r, lanes, a, b)
    turned = larger(dot(turn_a, turn_a), dot(turn_b, turn_b))
    lag = three(lanes, r + of.LAG)
    far = choose(load(lanes, r + of.BALL), zero, larger(turned - TURNED * TURNED, dot(lag, lag)))
    if not some(far):
        for p in range(points):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            store(lanes, q + of.DEPTH, load(lanes, q + of.DEPTH) - parting_at(q, lanes, parting))
        return
    goes_along = choose(far, spread(1.0) if fresh else dot(lag, lag), zero)
    face = turn_of_face(r, goes_along, turn_a, turn_b, lanes)
    face = plus(face, where(goes_along, turn_between(r, a, b, lanes)))
    x, y, z = plus(lag, face)
    keep(lanes, r + of.LAG, x, y, z)
    turn_a, turn_b = minus(turn_a, face), minus(turn_b, face)
    turned = larger(dot(turn_a, turn_a), dot(turn_b, turn_b))
    store(lanes, r + of.SWUNG, load(lanes, r + of.SWUNG) + root(choose(far, turned, zero)))
    frame = frame_of(r, lanes)
    part, core_a, core_b = choose(far, spread(0.5), zero), load(lanes, r + of.CORE_A), load(lanes, r + of.CORE_B)
    half_a = times(choose(core_a + 0.5, part, zero), seen_from(frame, turn_a))
    half_b = times(choose(core_b + 0.5, part, zero), seen_from(frame, turn_b))
    s_a, q_a, z_a = three(lanes, r + of.MIDDLE_A)
    s_b, q_b, z_b = three(lanes, r + of.MIDDLE_B)
    by_a, by_b = swung(half_a, (s_a, q_a, z_a - core_a)), swung(half_b, (s_b, q_b, z_b + core_b))
    goes = load(lanes, r + of.GOES)
    round_a = choose(0.25 - goes, larger(core_a, zero), zero)
    round_b = choose(goes - 0.75, larger(core_b, zero), zero)
    set_out = dot(lag, lag)  # where bodies meet in the middle of the substep, and will in that of the next
    on_a, on_b = rolled_over(choose(set_out, zero, round_a), choose(set_out, zero, round_b), half_a, half_b)
    keep(lanes, r + of.MIDDLE_A, s_a + by_a[0] + on_a[0], q_a + by_a[1] + on_a[1], z_a + by_a[2])
    keep(lanes, r + of.MIDDLE_B, s_b + by_b[0] + on_b[0], q_b + by_b[1] + on_b[1], z_b + by_b[2])
    about = (zero, zero, half_a[2] + goes * (half_b[2] - half_a[2]))
    rolls = choose(round_a, spread(1.0), choose(round_b, spread(-1.0), zero))
    rolling, level, sinks = rolls * rolls, zero, zero
    if some(rolling):
        along, across = choose(round_a, half_a[0], half_b[0]), choose(round_a, half_a[1], half_b[1])
        about = choose(rolling, along, zero), choose(rolling, across, zero), about[2]
        level = level_of(r, points, lanes)
        sinks = (by_b[1] + on_b[1]) * half_b[0] - (by_b[0] + on_b[0]) * half_b[1]
        sinks = choose(rolling, sinks - (by_a[1] + on_a[1]) * half_a[0] + (by_a[0] + on_a[0]) * half_a[1], zero)
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        x, y, deep = load(lanes, q + of.AT), load(lanes, q + of.AT + 1), load(lanes, q + of.DEPTH)
        by = swung(about, (x, y, rolls * choose(deep - 0.5 * ABSENT, deep - level, zero)))
        more = sinks + 0.5 * rolling * (by[1] * parting[1] - by[0] * parting[2])
        store(lanes, q + of.DEPTH, deep - parting_at(q, lanes, parting) - more)
        store(lanes, q + of.AT, x + by[0])
        store(lanes, q + of.AT + 1, y + by[1])


@woven
def level_of(r, points, lanes):
    """Return how deep the points of manifolds are on the average."""
    level, share = spread(0.0), load(lanes, r + of.SHARE)
    for p in range(points):
        deep = load(lanes, r + MANIFOLD_ROWS + POINT_ROWS * p + of.DEPTH)
        level = level + share * choose(deep - 0.5 * ABSENT, deep, spread(0.0))
    return level


@woven
def rolled_over(round_a, round_b, half_a, half_b):
    """Return how far along both tangents the middle goes on from either body, where what is round rolls over a face.

    It is straight above or below the middle of the round, of radius ``round_a`` or ``round_b``, however the face turns.
    """
    a_t, a_u, b_t, b_u = 2.0 * half_a[0], 2.0 * half_a[1], 2.0 * half_b[0], 2.0 * half_b[1]
    against_t, against_u = b_t - a_t, b_u - a_u
    on_a = (round_a * b_u + round_b * against_u, -(round_a * b_t + round_b * against_t))
    on_b = (round_a * against_u - round_b * a_u, round_b * a_t - round_a * against_t)
    return on_a, on_b
