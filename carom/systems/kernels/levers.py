"""Levers: how bodies part at the points of a manifold, in its frame of two tangents t, u and the normal n.

A point at r = s t + q u + z n has the lever r x n = q t - s u, whatever z is. The middle of a manifold's points has one
about each body; where a point is from the middle is the same for both.
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import TURNED
from carom.systems.kernels import groups as of
from carom.systems.kernels.groups import ABSENT, MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import cross, dot, keep, plus, three, times
from carom.systems.kernels.lanes import choose, larger, load, root, some, spread, store
from carom.systems.kernels.packing import DRIVEN


@woven
def frame_of(r, lanes):
    """Return the tangents and the normal of a group."""
    return three(lanes, r + of.TANGENT), three(lanes, r + of.TANGENT + 3), three(lanes, r + of.NORMAL)


@woven
def parting_of(r, lanes, a, b):
    """Return how fast bodies part at the middle, and how fast b turns against a about the tangents.

    Of the ways of bodies instead of their velocities: how far.
    """
    t, u, n = frame_of(r, lanes)
    a_t, a_u, b_t, b_u = dot(t, a[4:7]), dot(u, a[4:7]), dot(t, b[4:7]), dot(u, b[4:7])
    s_a, q_a, _ = three(lanes, r + of.MIDDLE_A)
    s_b, q_b, _ = three(lanes, r + of.MIDDLE_B)
    off = dot(n, (b[0] - a[0], b[1] - a[1], b[2] - a[2]))
    return off + ((q_b * b_t - s_b * b_u) - (q_a * a_t - s_a * a_u)), b_t - a_t, b_u - a_u


@woven
def parting_at(q, lanes, parting):
    """Return how fast bodies part at a point, by what `parting_of` returns."""
    return parting[0] + (load(lanes, q + of.AT + 1) * parting[1] - load(lanes, q + of.AT) * parting[2])


@woven
def sink_points(r, points, lanes, a, b):
    """Write how deep the points of a group have come to be as its bodies went on their ways, and where they are by now.

    A point goes with both bodies, to first order of their turn, with what is round to second order; then it goes on in
    its frame, which stays. The middle goes with either body, as it does where nothing slips, and with what is round
    over the face of the other (`rolled_over`); points turn about it with whose corners they are: of neither, or of
    both, half as much (`goes_with_b`). Those of what is round go with its axis, which leans as they are deep. What else
    is smooth turns beneath its points; `roll_on` says where those go, and `follow_turning` where those on a kinematic
    body do that turns.
    """
    zero, turn_a, turn_b = spread(0.0), a[4:7], b[4:7]
    parting = parting_of(r, lanes, a, b)
    turned = larger(dot(turn_a, turn_a), dot(turn_b, turn_b))
    far = choose(larger(load(lanes, r + of.BALL), a[DRIVEN] + b[DRIVEN]), zero, turned - TURNED * TURNED)
    if not some(far):
        for p in range(points):
            q = r + MANIFOLD_ROWS + POINT_ROWS * p
            store(lanes, q + of.DEPTH, load(lanes, q + of.DEPTH) - parting_at(q, lanes, parting))
        return
    store(lanes, r + of.SWUNG, load(lanes, r + of.SWUNG) + root(choose(far, turned, zero)))
    t, u, n = frame_of(r, lanes)
    part, core_a, core_b = choose(far, spread(0.5), zero), load(lanes, r + of.CORE_A), load(lanes, r + of.CORE_B)
    half_a = times(choose(core_a + 0.5, part, zero), (dot(t, turn_a), dot(u, turn_a), dot(n, turn_a)))
    half_b = times(choose(core_b + 0.5, part, zero), (dot(t, turn_b), dot(u, turn_b), dot(n, turn_b)))
    s_a, q_a, z_a = three(lanes, r + of.MIDDLE_A)
    s_b, q_b, z_b = three(lanes, r + of.MIDDLE_B)
    by_a, by_b = swung(half_a, (s_a, q_a, z_a - core_a)), swung(half_b, (s_b, q_b, z_b + core_b))
    goes = load(lanes, r + of.GOES)
    round_a = choose(0.25 - goes, larger(core_a, zero), zero)
    round_b = choose(goes - 0.75, larger(core_b, zero), zero)
    on_a, on_b = rolled_over(round_a, round_b, half_a, half_b)
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


@woven
def swung(half, x):
    """Return what a turn by twice ``half`` (rad) adds to a vector, to second order: it stays as long (Cayley)."""
    across = cross(half, x)
    return times(2.0 / (1.0 + dot(half, half)), plus(across, cross(half, across)))


@woven
def coupled(lanes, p, o, along, by_t, by_u, inertia):
    """Return how fast a unit impulse at one point parts another.

    At the middle one parts the bodies there at ``along`` and turns them at ``by_t`` and ``by_u`` about the tangents;
    ``inertia`` is the inverse inertia of both against each other, as `in_frame` returns it.
    """
    s_p, q_p, s_o, q_o = (
        load(lanes, p + of.AT),
        load(lanes, p + of.AT + 1),
        load(lanes, o + of.AT),
        load(lanes, o + of.AT + 1),
    )
    tt, tu, uu = inertia
    turning = q_p * (q_o * tt - s_o * tu) + s_p * (s_o * uu - q_o * tu)
    return along + (by_t * (q_p + q_o) + by_u * -(s_p + s_o)) + turning
