"""Who touches whom, carried from step to step."""

from __future__ import annotations

from math import inf

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import TOUCH
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.recycling import first_of_pair, is_at, is_pair, row_of


@woven
def find_struck(count, a, b, time, handles, row_shift, struck_a, struck_b, struck_at):
    """Write the pairs (rows) of those alive that ``count`` impacts were of, in order, each with its first time.

    Return how many they are.
    """
    n = 0
    for k in range(count):
        x, y = row_of(a[k], row_shift), row_of(b[k], row_shift)
        if is_at(x, a[k], handles) and is_at(y, b[k], handles):
            struck_a[n], struck_b[n], struck_at[n] = min(x, y), max(x, y), time[k]
            n += 1
    sort_rows(n, struck_a, struck_b, struck_at)
    pairs = 0
    for k in range(n):
        if pairs == 0 or struck_a[k] != struck_a[pairs - 1] or struck_b[k] != struck_b[pairs - 1]:
            struck_a[pairs], struck_b[pairs], struck_at[pairs] = struck_a[k], struck_b[k], struck_at[k]
            pairs += 1
    return pairs


@kernel("end_time", "end_a", "end_b", "begin_time", "begin_a", "begin_b", "was_a", "was_b", "was_since")
def write_touching(
    count, ends, began, end_time, end_a, end_b, found, a, b, since, begins, begin_time, begin_a, begin_b,
    was_a, was_b, was_since,
):  # fmt: skip
    """Write the ``found`` pairs in the place of ``count``, and who ends and begins in order of time, then handles.

    Those that end did so at some time within the step that ``began`` (s) then.
    """
    ended, new = 0, 0
    for o in range(count):
        if ends[o]:
            end_time[ended], end_a[ended], end_b[ended] = began, was_a[o], was_b[o]
            ended += 1
    for n in range(found):
        if begins[n]:
            begin_time[new], begin_a[new], begin_b[new] = since[n], a[n], b[n]
            new += 1
        was_a[n], was_b[n], was_since[n] = a[n], b[n], since[n]
    sort_rows(ended, end_time, end_a, end_b)
    sort_rows(new, begin_time, begin_a, begin_b)


@woven
def sort_rows(count, first, second, third):
    """Sort rows of three columns by the first, then the second, then the third (Shell, CACM 2 (7), 1959)."""
    gap = count // 2
    while gap > 0:
        for k in range(gap, count):
            x, y, z, o = first[k], second[k], third[k], k
            while o >= gap and comes_before(x, y, z, o - gap, first, second, third):
                p = o - gap
                first[o], second[o], third[o] = first[p], second[p], third[p]
                o = p
            first[o], second[o], third[o] = x, y, z
        gap //= 2


@woven
def comes_before(x, y, z, o, first, second, third):
    """Tell whether three numbers come before those of row o."""
    if x != first[o]:
        return x < first[o]
    if y != second[o]:
        return y < second[o]
    return z < third[o]


@kernel(
    "hit_time", "hit_a", "hit_b", "hit_point", "hit_normal", "hit_speed", "hit_impulse", "hit_work",
    "hit_friction_impulse", "material_a", "material_b",
    makes_arrays=True,
)  # fmt: skip
def find_hits(
    count, least, handles, row_shift, number, time, a, b, point, normal, speed, impulse, work, friction_impulse,
    hit_time, hit_a, hit_b, hit_point, hit_normal, hit_speed, hit_impulse, hit_work, hit_friction_impulse,
    material_a, material_b,
):  # fmt: skip
    """Write those of ``count`` impacts that are as fast as the ``least`` hit, in order of time, then handles.

    Their materials are -1 of who lives no more. Return how many they are.
    """
    hits, order = 0, np.empty(count, np.int64)
    for k in range(count):
        if not speed[k] >= least:
            continue
        o = hits
        while o > 0 and is_earlier(k, order[o - 1], a, b, time):  # seldom: they are in order of time
            order[o] = order[o - 1]
            o -= 1
        order[o] = k
        hits += 1
    for o in range(hits):
        k = order[o]
        hit_time[o], hit_a[o], hit_b[o], hit_speed[o] = time[k], a[k], b[k], speed[k]
        hit_impulse[o], hit_work[o] = impulse[k], work[k]
        for d in range(3):
            hit_point[o, d], hit_normal[o, d] = point[k, d], normal[k, d]
            hit_friction_impulse[o, d] = friction_impulse[k, d]
        x, y = a[k], b[k]
        i, j = row_of(x, row_shift), row_of(y, row_shift)
        material_a[o] = number[i] if is_at(i, x, handles) else -1
        material_b[o] = number[j] if is_at(j, y, handles) else -1
    return hits


@woven
def is_earlier(k, o, a, b, time):
    """Tell whether impact k comes before impact o: in order of time, then handles."""
    if time[k] != time[o]:
        return time[k] < time[o]
    if a[k] != a[o]:
        return a[k] < a[o]
    return b[k] < b[o]


@kernel("struck_a", "struck_b", "struck_at", "a", "b", "since", "begins", "ends")
def renew_touching(
    points, contact_a, contact_b, row_a, row_b, impulse, depth,
    impacts, impact_a, impact_b, impact_time, struck_a, struck_b, struck_at, now,
    count, was_a, was_b, was_since, handles, row_shift, body_row, asleep, a, b, since, begins, ends,
):  # fmt: skip
    """Write the pairs that touch, since when, and whether each ``begins``; ``ends`` tells which of those before do not.

    ``points`` rows of the contact table are in order of rows, as the ``count`` pairs before were. Pairs that were
    struck, for which there is room in ``struck_a``, ``struck_b`` and ``struck_at``, begin at the first of the
    ``impacts`` that were of them, others ``now``. Nobody looks for contacts of those who sleep: they go on touching.
    Returns how many pairs touch and how many of them begin.
    """
    for o in range(count):
        ends[o] = True
    struck = find_struck(
        impacts, impact_a, impact_b, impact_time, handles, row_shift, struck_a, struck_b, struck_at
    )  # fmt: skip
    c, s, o, n, new = 0, 0, 0, 0, 0
    while c < points or s < struck:
        strikes = s < struck
        if strikes and c < points:
            strikes = struck_a[s] < row_a[c] or (struck_a[s] == row_a[c] and struck_b[s] <= row_b[c])
        x, y = (struck_a[s], struck_b[s]) if strikes else (row_a[c], row_b[c])
        presses, deepest, living = strikes, -inf, True
        if c < points and row_a[c] == x and row_b[c] == y:  # then all of its contacts are of the same two
            living = is_at(x, contact_a[c], handles) and is_at(y, contact_b[c], handles)
        while c < points and row_a[c] == x and row_b[c] == y:
            presses |= impulse[c] > 0.0
            deepest = max(deepest, depth[c])
            c += 1
        known = is_pair(o, count, x, y, was_a, was_b, handles)  # most often
        if not known:
            before, o = o, first_of_pair(o, count, x, y, was_a, was_b, handles, row_shift)
            n = keep_sleepers(
                before, o, was_a, was_b, was_since, handles, row_shift, body_row, asleep, n, a, b, since, begins, ends
            )
            known = is_pair(o, count, x, y, was_a, was_b, handles)
        if living and (presses or deepest >= 0.0 or (known and deepest >= -TOUCH)):
            a[n], b[n], begins[n] = handles[x], handles[y], not known
            if known:
                since[n], ends[o] = was_since[o], False
                o += 1
            else:
                since[n] = struck_at[s] if strikes else now
                new += 1
            n += 1
        s += 1 if strikes else 0
    n = keep_sleepers(
        o, count, was_a, was_b, was_since, handles, row_shift, body_row, asleep, n, a, b, since, begins, ends
    )
    return n, new


@woven
def keep_sleepers(
    begin, end, was_a, was_b, was_since, handles, row_shift, body_row, asleep, n, a, b, since, begins, ends
):
    """Let pairs go on touching of which one sleeps; return how many pairs there are then."""
    for o in range(begin, end):
        q, r = row_of(was_a[o], row_shift), row_of(was_b[o], row_shift)
        living = is_at(q, was_a[o], handles) and is_at(r, was_b[o], handles)
        if ends[o] and living and (sleeps(q, body_row, asleep) or sleeps(r, body_row, asleep)):
            a[n], b[n], since[n], begins[n], ends[o] = was_a[o], was_b[o], was_since[o], False, False
            n += 1
    return n


@woven
def sleeps(collider, body_row, asleep):
    """Tell whether a collider is of a body that sleeps."""
    return body_row[collider] >= 0 and asleep[body_row[collider]]
