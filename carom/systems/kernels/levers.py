"""Levers: how bodies part at the points of a manifold, in its frame of two tangents t, u and the normal n.

A point at r = s t + q u + z n has the lever r x n = q t - s u, whatever z is. The middle of a manifold's points has one
about each body; where a point is from the middle is the same for both.
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import groups as of
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import dot, three
from carom.systems.kernels.lanes import load


@woven
def frame_of(r, lanes):
    """Return the tangents and the normal of a group."""
    return three(lanes, r + of.TANGENT), three(lanes, r + of.TANGENT + 3), three(lanes, r + of.NORMAL)


@woven
def seen_from(frame, x):
    """Return a vector in a frame."""
    return dot(frame[0], x), dot(frame[1], x), dot(frame[2], x)


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
