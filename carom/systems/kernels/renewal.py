"""Renewal: contacts found take the places of those before, and keep what they held."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import SAME_POINT
from carom.systems.kernels.crew import runs_of, shared, wait_for_all
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.recycling import first_of_pair, is_pair, smaller_reach

CONTACT_NUMBERS = 29  # that a contact holds


@woven
def are_the_same(c, end, o, until, found_feature, feature):
    """Tell whether a pair has the points that it had, each once."""
    same = until - o == end - c
    for k in range(end - c if same else 0):
        same &= feature[o + k] == found_feature[c + k] and (k == 0 or feature[o + k] > feature[o + k - 1])
    return same


@inlined
def match_points(begin, end, o, until, near, feature, point, found_feature, found_point, match, taken):
    """Write which contact, o to ``until``, each of a pair found is: that of its feature, else the nearest left over."""
    for new in range(begin, end):
        for old in range(o, until):
            if feature[old] == found_feature[new]:
                match[new], taken[old] = old, True
    for new in range(begin, end):
        nearest = near**2
        for old in range(o, until if match[new] < 0 else o):
            away = 0.0
            for k in range(3):
                away += (point[old, k] - found_point[new, k]) ** 2
            if not taken[old] and away < nearest:
                match[new], nearest = old, away
        if match[new] >= 0:
            taken[match[new]] = True


@shared(
    "match", "taken", "changed", "a", "b", "feature", "row_a", "row_b", "by_fcl", "normal", "depth", "point", "resting",
    "warm_normal", "warm_friction", "warm_rolling", "impulse", "friction_impulse", "strikes", "plastic",
    "seat_a", "seat_b", "lean_a", "lean_b", "seat_depth", "seat_reach", "form",
    makes_arrays=True,
)  # fmt: skip
def renew_contacts(
    crew, match, taken, changed, old_count, handles, row_shift, bound_half, bound_radius,
    found_a, found_b, found_feature, found_normal, found_depth, found_point, found_by_fcl, recycled_from,
    a, b, feature, row_a, row_b, by_fcl, normal, depth, point, resting,
    warm_normal, warm_friction, warm_rolling, impulse, friction_impulse, strikes, plastic,
    seat_a, seat_b, lean_a, lean_b, seat_depth, seat_reach, form,
):  # fmt: skip
    """Replace the contacts by those found, keeping what a contact of the same colliders and feature held.

    Both lists are sorted by rows and feature, so that one pass matches them: ``match`` (-1: none) is which one of the
    old each was, as those recycled know (``recycled_from``); ``taken`` are those that somebody was. Where corners and
    edges change places under bodies that hardly move, a point of another feature within SAME_POINT takes over what the
    old one held. Where on the two shapes they were found goes with those recycled only: of others `complete_contacts`
    says it. Each thread tells in ``changed`` whether one of its contacts has come to a place in which it was not.
    """
    begin, count = runs_of(crew, found_a, found_b)
    o, c = 0, begin
    while c < count:
        x, y = found_a[c], found_b[c]
        end = c + 1
        while end < count and found_a[end] == x and found_b[end] == y:
            end += 1
        if recycled_from[c] >= 0:
            for k in range(c, end):
                match[k] = recycled_from[k]
            o, c = match[end - 1] + 1, end
            continue
        o = first_of_pair(o, old_count, x, y, a, b, handles, row_shift)
        until = o
        while is_pair(until, old_count, x, y, a, b, handles):
            until += 1
        if are_the_same(c, end, o, until, found_feature, feature):
            for k in range(end - c):
                match[c + k] = o + k
        else:
            for k in range(c, end):
                match[k] = -1
            match_points(
                c, end, o, until, SAME_POINT * smaller_reach(x, y, bound_half, bound_radius),
                feature, point, found_feature, found_point, match, taken,
            )  # fmt: skip
        o, c = until, end
    # Rows that stay where they are keep what they hold. Of the others most come from a few rows away, in place: those
    # from behind in their order, and those from before the last first, so that none is written over before it has gone.
    # What is another thread's, or changes places within a pair, is put aside before.
    columns = (
        resting, strikes, plastic, warm_normal, impulse, warm_friction, warm_rolling, friction_impulse,
        seat_depth, seat_reach, form, seat_a, seat_b, lean_a, lean_b,
    )  # fmt: skip
    moves = np.empty(max(0, count - begin), np.int64)
    moving, aside, last = 0, len(moves), -1
    for c in range(begin, count):
        if begin <= match[c] < count and match[c] > last:
            last = match[c]
            moves[moving] = c
            moving += match[c] != c
        elif match[c] != c:
            aside -= 1
            moves[aside] = c
    changed[crew[1]] = moving > 0 or aside < len(moves)
    kept = np.zeros((len(moves) - aside, CONTACT_NUMBERS))
    for m in range(aside, len(moves)):
        c = moves[m]
        if match[c] >= 0:
            take(match[c], recycled_from[c] >= 0, kept, m - aside, *columns)
    wait_for_all(crew, 1)
    for m in range(moving):
        c = moves[m]
        if match[c] > c:
            move(match[c], c, recycled_from[c] >= 0, *columns)
    for m in range(moving - 1, -1, -1):
        c = moves[m]
        if match[c] < c:
            move(match[c], c, recycled_from[c] >= 0, *columns)
    for m in range(aside, len(moves)):
        give(moves[m], recycled_from[moves[m]] >= 0, kept, m - aside, *columns)
    for c in range(begin, count):
        if match[c] != c:
            a[c], b[c] = handles[found_a[c]], handles[found_b[c]]
        row_a[c], row_b[c], feature[c], by_fcl[c] = found_a[c], found_b[c], found_feature[c], found_by_fcl[c]
        depth[c] = found_depth[c]
        for k in range(3):
            normal[c, k], point[c, k] = found_normal[c, k], found_point[c, k]


@woven
def move(
    o, c, seated, resting, strikes, plastic, warm_normal, impulse, warm_friction, warm_rolling, friction_impulse,
    seat_depth, seat_reach, form, seat_a, seat_b, lean_a, lean_b,
):  # fmt: skip
    """Let contact c hold what contact o does, and be ``seated`` where that is."""
    resting[c], strikes[c], plastic[c], warm_normal[c], impulse[c] = (
        resting[o], strikes[o], plastic[o], warm_normal[o], impulse[o]
    )  # fmt: skip
    for column in (warm_friction, warm_rolling, friction_impulse):
        column[c, 0], column[c, 1], column[c, 2] = column[o, 0], column[o, 1], column[o, 2]
    if seated:
        seat_depth[c], seat_reach[c], form[c] = seat_depth[o], seat_reach[o], form[o]
        for column in (seat_a, seat_b, lean_a, lean_b):
            column[c, 0], column[c, 1], column[c, 2] = column[o, 0], column[o, 1], column[o, 2]


@woven
def take(
    o, seated, kept, m, resting, strikes, plastic, warm_normal, impulse, warm_friction, warm_rolling, friction_impulse,
    seat_depth, seat_reach, form, seat_a, seat_b, lean_a, lean_b,
):  # fmt: skip
    """Write what contact o holds into a row of numbers, and where it is ``seated``."""
    kept[m, 0], kept[m, 1], kept[m, 2], kept[m, 3], kept[m, 4] = (
        resting[o], strikes[o], plastic[o], warm_normal[o], impulse[o]
    )  # fmt: skip
    for k in range(3):
        kept[m, 5 + k], kept[m, 8 + k] = warm_friction[o, k], warm_rolling[o, k]
        kept[m, 11 + k] = friction_impulse[o, k]
    if seated:
        kept[m, 14], kept[m, 15], kept[m, 28] = seat_depth[o], form[o], seat_reach[o]
        for k in range(3):
            kept[m, 16 + k], kept[m, 19 + k] = seat_a[o, k], seat_b[o, k]
            kept[m, 22 + k], kept[m, 25 + k] = lean_a[o, k], lean_b[o, k]


@woven
def give(
    c, seated, kept, m, resting, strikes, plastic, warm_normal, impulse, warm_friction, warm_rolling, friction_impulse,
    seat_depth, seat_reach, form, seat_a, seat_b, lean_a, lean_b,
):  # fmt: skip
    """Let contact c hold what `take` has written."""
    resting[c], strikes[c], plastic[c], warm_normal[c], impulse[c] = (
        kept[m, 0] != 0.0, kept[m, 1], kept[m, 2], kept[m, 3], kept[m, 4]
    )  # fmt: skip
    for k in range(3):
        warm_friction[c, k], warm_rolling[c, k] = kept[m, 5 + k], kept[m, 8 + k]
        friction_impulse[c, k] = kept[m, 11 + k]
    if seated:
        seat_depth[c], form[c], seat_reach[c] = kept[m, 14], kept[m, 15], kept[m, 28]
        for k in range(3):
            seat_a[c, k], seat_b[c, k] = kept[m, 16 + k], kept[m, 19 + k]
            lean_a[c, k], lean_b[c, k] = kept[m, 22 + k], kept[m, 25 + k]
