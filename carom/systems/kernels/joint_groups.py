"""Groups of joints: up to eight that are alike and share no moving body, so that they can be solved side by side."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.components.joint import LIMITED, LINE, LOCKED, SLOTS, SWING_TWIST
from carom.systems.kernels.kernel import inlined, kernel, woven
from carom.systems.kernels.lanes import WIDTH

# Kinds of groups by the ways that their joints hold: the line between the anchors, the three coordinates of a point,
# and the six of a frame by either measure of turns; each once without limits, drives and friction, and once with.
LINES, POINTS, FRAMES, CONES, KINDS = 0, 1, 2, 3, 4

# Rows of eight numbers that a group has, a lane each joint: levers from the centres of mass and frames, as the bodies
# see them; then where they are: from either centre to the anchor of b; how fast they may go back there; and the cosine
# of the second angle, by which the axes of the others are less than their rates where these are locked.
LEVER_A, LEVER_B, FRAME_A, FRAME_B, ARM_A, ARM_B, BACK, LEVEL, FIRST = 0, 3, 6, 10, 14, 17, 20, 21, 22
# Rows of each way that may be held: its axis, where b is along it and how fast it goes, where it is locked, 1 where it
# is, and the impulse that holds it, of the substep and summed over the step.
AXIS, PLACE, SPEED, AT, HELD, HOLD, SUM, SLOT_ROWS = 0, 3, 4, 5, 6, 7, 8, 9
# Then the triangle of D and L of the locked ways' L D L^T (the inverse of D on the diagonal), and in a group with
# limits, drives or friction rows of each way: its limits, and their restitution; how stiffly and damped it is driven, 0
# where it yields to nothing, where to and how fast, and the most force; friction; a unit impulse on it, with what that
# asks of the locks, as a push and a twist, and how fast it gives way to that; impulses of drive and friction, and their
# sums.
LOWER, UPPER, BOUNCE, STIFFNESS, DAMPING, YIELDS, TARGET, WANTED, MOST, RUBS = range(10)
PUSH, TWIST, GIVE, DRIVE, DRIVE_SUM, RUB, RUB_SUM, BOUND_ROWS = 10, 13, 16, 17, 18, 19, 20, 21
# Behind the triangle of points, which need not ask the bodies then: their inverse masses and upper halves of inertias.
MASS_A, MASS_B, INVERSE_A, INVERSE_B, INERT_ROWS = 0, 3, 6, 12, 18

# What all joints of a group ask for: a bit for each way with a limit, then with a drive, then with friction.
LIMIT_BIT, DRIVE_BIT, FRICTION_BIT, MOST_ASKED = 1, 1 << SLOTS, 1 << 2 * SLOTS, 1 << 3 * SLOTS


@woven
def slot(r, s):
    """Return the first row of way s of a group that begins at r."""
    return r + FIRST + SLOT_ROWS * s


@woven
def factor(r, slots, i, j):
    """Return the row of L D L^T, j <= i, of a group with so many ways."""
    return r + FIRST + SLOT_ROWS * slots + i * (i + 1) // 2 + j


@woven
def bound(r, slots, s):
    """Return the first row of what bounds way s."""
    return factor(r, slots, slots, 0) + BOUND_ROWS * s


@woven
def end_of(r, kind):
    """Return the row behind a group of a kind that begins at r."""
    slots = slots_of(kind)
    if kind == POINTS:
        return factor(r, slots, slots, 0) + INERT_ROWS
    return bound(r, slots, slots if kind >= KINDS else 0)


@woven
def slots_of(kind):
    """Return how many ways a joint of a kind may hold."""
    if kind % KINDS == LINES:
        return 1
    return 3 if kind % KINDS == POINTS else SLOTS


@inlined
def kind_of(i, along, about, mode, lower, driven, friction):
    """Return the kind of the group that joint i belongs into."""
    bounded, turns, point = False, False, True
    for s in range(SLOTS):
        bounds = mode[i, s] == LIMITED or driven[i, s] or friction[i, s] > 0.0
        bounded |= bounds
        if s < 3:
            point &= mode[i, s] == LOCKED and not bounds and lower[i, s] == 0.0
        else:
            turns |= mode[i, s] == LOCKED or bounds
    shift = KINDS if bounded else 0
    if along[i] == LINE:
        return LINES + shift
    if point and not turns:
        return POINTS
    return (CONES if about[i] == SWING_TWIST else FRAMES) + shift


@inlined
def asks_of(i, mode, driven, stiffness, damping, friction):
    """Return what joint i asks for beside what it locks."""
    asks = 0
    for s in range(SLOTS):
        if mode[i, s] == LIMITED:
            asks |= LIMIT_BIT << s
        if driven[i, s] and (damping[i, s] > 0.0 or stiffness[i, s] > 0.0):
            asks |= DRIVE_BIT << s
        if friction[i, s] > 0.0:
            asks |= FRICTION_BIT << s
    return asks


@kernel("kinds", "asks", "index_a", "index_b", "first", "place", "row", makes_arrays=True)
def group_joints(
    joints, body_a, body_b, inverse_mass, nobody, along, about, mode, lower, driven, stiffness, damping, friction,
    kinds, asks, index_a, index_b, first, place, row,
):  # fmt: skip
    """Put joints (rows) into groups that, one after the other, do what the joints would in the order of their rows.

    A joint's level is one more than any level before it of its bodies; those of a level share no moving body. A chain
    is solved from one end to the other: so what holds one link is felt by all in one sweep. Return (groups, rows of
    all); ``body_a`` and ``body_b`` are rows of bodies, -1 for none, ``first`` is the row of the joint in each lane and
    ``place`` where it is among ``joints``.
    """
    count = len(joints)
    reached, like = np.zeros(len(inverse_mass), np.int64), np.empty(count, np.int64)
    for n in range(count):
        i, a, b = joints[n], body_a[n], body_b[n]
        moving_a, moving_b = a >= 0 and inverse_mass[a] > 0.0, b >= 0 and inverse_mass[b] > 0.0
        level = max(reached[a] if moving_a else 0, reached[b] if moving_b else 0)
        if moving_a:
            reached[a] = level + 1
        if moving_b:
            reached[b] = level + 1
        kind = kind_of(i, along, about, mode, lower, driven, friction)
        asked = asks_of(i, mode, driven, stiffness, damping, friction)
        like[n] = (level * 2 * KINDS + kind) * MOST_ASKED + asked
    group, lane, rows, last = -1, WIDTH, 0, -1
    for n in np.argsort(like, kind="mergesort"):
        if lane == WIDTH or like[n] != last:
            group, lane, last = group + 1, 0, like[n]
            kinds[group], asks[group], row[group] = last // MOST_ASKED % (2 * KINDS), last % MOST_ASKED, rows
            rows = end_of(rows, kinds[group])
            for other in range(WIDTH):
                index_a[group, other], index_b[group, other], first[group, other] = nobody, nobody, -1
        index_a[group, lane] = body_a[n] if body_a[n] >= 0 else nobody
        index_b[group, lane] = body_b[n] if body_b[n] >= 0 else nobody
        first[group, lane], place[group, lane] = joints[n], n
        lane += 1
    return group + 1, rows
