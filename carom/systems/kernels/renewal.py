"""Renewal: contacts found take the places of those before, and keep what they held."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import SAME_POINT
from carom.systems.kernels.carrying import carry, lift, moves_of, rows_of
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
    "seat_a", "seat_b", "lean_a", "lean_b", "seat_depth", "seat_reach", "form", "body_a", "body_b", "offset_a",
    "offset_b", "share", "friction", "restitution", "rolling", "spinning", "surface", "kind",
    makes_arrays=True,
)  # fmt: skip
def renew_contacts(
    crew, match, taken, changed, old_count, handles, row_shift, bound_half, bound_radius,
    found_a, found_b, found_feature, found_normal, found_depth, found_point, found_by_fcl, recycled_from,
    a, b, feature, row_a, row_b, by_fcl, normal, depth, point, resting,
    warm_normal, warm_friction, warm_rolling, impulse, friction_impulse, strikes, plastic,
    seat_a, seat_b, lean_a, lean_b, seat_depth, seat_reach, form, body_a, body_b, offset_a, offset_b, share,
    friction, restitution, rolling, spinning, surface, kind,
):  # fmt: skip
    """Replace the contacts by those found, keeping what a contact of the same colliders and feature held.

    Both lists are sorted by rows and feature, so that one pass matches them: ``match`` (-1: none) is which one of the
    old each was, as those recycled know (``recycled_from``), of which the table has all; ``taken`` are those that
    somebody was. Where corners and edges change places under bodies that hardly move, a point of another feature within
    SAME_POINT takes over what the old one held. What follows from the colliders goes with those recycled only: of
    others `complete_contacts` says it. Each thread tells in ``changed`` whether one of its contacts has come to a place
    in which it was not.
    """
    begin, end = runs_of(crew, found_a, found_b)
    recycled = match_pairs(
        begin, end, old_count, handles, row_shift, bound_half, bound_radius, a, b, feature, point,
        found_a, found_b, found_feature, found_point, recycled_from, match, taken,
    )  # fmt: skip
    held = (
        rows_of(resting), rows_of(strikes), rows_of(plastic), rows_of(warm_normal), rows_of(warm_friction),
        rows_of(warm_rolling), rows_of(impulse), rows_of(friction_impulse),
    )  # fmt: skip
    of_recycled = (
        rows_of(a), rows_of(b), rows_of(feature), rows_of(row_a), rows_of(row_b), rows_of(by_fcl), rows_of(normal),
        rows_of(depth), rows_of(point), rows_of(seat_a), rows_of(seat_b), rows_of(lean_a), rows_of(lean_b),
        rows_of(seat_depth), rows_of(seat_reach), rows_of(form), rows_of(body_a), rows_of(body_b), rows_of(offset_a),
        rows_of(offset_b), rows_of(share), rows_of(friction), rows_of(restitution), rows_of(rolling),
        rows_of(spinning), rows_of(surface), rows_of(kind),
    )  # fmt: skip
    runs, aside = moves_of(begin, end, match)
    their_runs, their_aside = moves_of(begin, end if recycled else begin, recycled_from)
    room, further = lift(held, match, aside), lift(of_recycled, recycled_from, their_aside)
    wait_for_all(crew, 1)
    carry(held, runs, aside, room)
    carry(of_recycled, their_runs, their_aside, further)
    changed[crew[1]] = len(runs) > 0 or len(aside) > 0
    for c in range(begin, end):
        if recycled_from[c] >= 0:
            continue
        a[c], b[c] = handles[found_a[c]], handles[found_b[c]]
        row_a[c], row_b[c], feature[c], by_fcl[c] = found_a[c], found_b[c], found_feature[c], found_by_fcl[c]
        depth[c] = found_depth[c]
        for k in range(3):
            normal[c, k], point[c, k] = found_normal[c, k], found_point[c, k]
        if match[c] < 0:
            changed[crew[1]] = True
            resting[c], strikes[c], plastic[c], warm_normal[c], impulse[c] = False, 0, 0, 0.0, 0.0
            for k in range(3):
                warm_friction[c, k] = warm_rolling[c, k] = friction_impulse[c, k] = 0.0


@woven
def match_pairs(
    c, count, old_count, handles, row_shift, bound_half, bound_radius, a, b, feature, point,
    found_a, found_b, found_feature, found_point, recycled_from, match, taken,
):  # fmt: skip
    """Write which of the old contacts each of those found was, from c to ``count``; tell whether some are recycled."""
    o, recycled = 0, False
    while c < count:
        if recycled_from[c] >= 0:  # most often
            match[c], recycled = recycled_from[c], True
            o, c = match[c] + 1, c + 1
            continue
        x, y = found_a[c], found_b[c]
        end = c + 1
        while end < count and found_a[end] == x and found_b[end] == y:
            end += 1
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
    return recycled
