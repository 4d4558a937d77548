"""Renewal: contacts found take the places of those before, and keep what they held."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import SAME_POINT
from carom.systems.kernels.crew import runs_of, shared, wait_for_all
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.recycling import first_of_pair, is_pair, smaller_reach


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
    "seat_a", "seat_b", "lean_a", "lean_b", "seat_depth", "form",
    makes_arrays=True,
)  # fmt: skip
def renew_contacts(
    crew, match, taken, changed, old_count, handles, row_shift, bound_half, bound_radius,
    found_a, found_b, found_feature, found_normal, found_depth, found_point, found_by_fcl, recycled_from,
    a, b, feature, row_a, row_b, by_fcl, normal, depth, point, resting,
    warm_normal, warm_friction, warm_rolling, impulse, friction_impulse, strikes, plastic,
    seat_a, seat_b, lean_a, lean_b, seat_depth, form,
):  # fmt: skip
    """Replace the contacts by those found, keeping what a contact of the same colliders and feature held.

    Both lists are sorted by rows and feature, so that one pass matches them: ``match`` (-1: none) is which one of the
    old each was, as those recycled know (``recycled_from``); ``taken`` are those that somebody was. Where corners and
    edges change places under bodies that hardly move, a point of another feature within SAME_POINT takes over what the
    old one held. Where on the two shapes they were found goes with those recycled only: others are `seat_contacts` to
    say. Each thread tells in ``changed`` whether one of its contacts has come to a place in which it was not.
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
    # Rows that stay where they are keep what they hold; what others held is put aside before it is written over.
    moves = np.empty(max(0, count - begin), np.int64)
    moving, seats = 0, 0
    for c in range(begin, count):
        if match[c] != c:
            moves[moving] = c
            moving, seats = moving + 1, seats + (recycled_from[c] >= 0)
    changed[crew[1]] = moving > 0
    kept, counted, seated = np.empty((moving, 11)), np.empty((moving, 3), np.int64), np.empty((seats, 14))
    n = 0
    for m in range(moving):
        o = match[moves[m]]
        if o < 0:
            continue
        counted[m, 0], counted[m, 1], counted[m, 2] = resting[o], strikes[o], plastic[o]
        kept[m, 0], kept[m, 1] = warm_normal[o], impulse[o]
        for k in range(3):
            kept[m, 2 + k], kept[m, 5 + k] = warm_friction[o, k], warm_rolling[o, k]
            kept[m, 8 + k] = friction_impulse[o, k]
        if recycled_from[moves[m]] >= 0:
            seated[n, 0], seated[n, 1] = seat_depth[o], form[o]
            for k in range(3):
                seated[n, 2 + k], seated[n, 5 + k] = seat_a[o, k], seat_b[o, k]
                seated[n, 8 + k], seated[n, 11 + k] = lean_a[o, k], lean_b[o, k]
            n += 1
    wait_for_all(crew, 1)
    n = 0
    for m in range(moving):
        c = moves[m]
        a[c], b[c] = handles[found_a[c]], handles[found_b[c]]
        if match[c] < 0:
            resting[c], strikes[c], plastic[c], warm_normal[c], impulse[c] = False, 0, 0, 0.0, 0.0
            for k in range(3):
                warm_friction[c, k] = warm_rolling[c, k] = friction_impulse[c, k] = 0.0
            continue
        resting[c], strikes[c], plastic[c] = counted[m, 0] != 0, counted[m, 1], counted[m, 2]
        warm_normal[c], impulse[c] = kept[m, 0], kept[m, 1]
        for k in range(3):
            warm_friction[c, k], warm_rolling[c, k] = kept[m, 2 + k], kept[m, 5 + k]
            friction_impulse[c, k] = kept[m, 8 + k]
        if recycled_from[c] >= 0:
            seat_depth[c], form[c] = seated[n, 0], seated[n, 1]
            for k in range(3):
                seat_a[c, k], seat_b[c, k] = seated[n, 2 + k], seated[n, 5 + k]
                lean_a[c, k], lean_b[c, k] = seated[n, 8 + k], seated[n, 11 + k]
            n += 1
    for c in range(begin, count):
        row_a[c], row_b[c], feature[c], by_fcl[c] = found_a[c], found_b[c], found_feature[c], found_by_fcl[c]
        depth[c] = found_depth[c]
        for k in range(3):
            normal[c, k], point[c, k] = found_normal[c, k], found_point[c, k]
