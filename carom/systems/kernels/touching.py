"""Who touches whom, carried from step to step."""

from __future__ import annotations

from math import inf

# mypy: disable-error-code="no-untyped-def"
from carom.ecs.entity import INDEX_MASK
from carom.systems.constants import TOUCH
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.recycling import first_of_pair


@kernel("a", "b", "since", "begins", "ends")
def renew_touching(
    points, contact_a, contact_b, row_a, row_b, impulse, depth,
    struck_a, struck_b, struck_at, now, count, was_a, was_b, was_since, handles, row_shift, body_row, asleep,
    a, b, since, begins, ends,
):  # fmt: skip
    """Write the pairs that touch, since when, and whether each ``begins``; ``ends`` tells which of those before do not.

    ``points`` rows of the contact table and the pairs (rows) that were struck, first at ``struck_at`` (s), are in order
    of rows, as the ``count`` pairs before were. Others than those struck begin ``now``. Nobody looks for contacts of
    those who sleep: they go on touching. Returns how many pairs touch and how many of them begin.
    """
    for o in range(count):
        ends[o] = True
    c, s, o, n, new = 0, 0, 0, 0, 0
    while c < points or s < len(struck_a):
        strikes = s < len(struck_a)
        if strikes and c < points:
            strikes = struck_a[s] < row_a[c] or (struck_a[s] == row_a[c] and struck_b[s] <= row_b[c])
        x, y = (struck_a[s], struck_b[s]) if strikes else (row_a[c], row_b[c])
        presses, deepest, living = strikes, -inf, True
        while c < points and row_a[c] == x and row_b[c] == y:
            presses |= impulse[c] > 0.0
            deepest = max(deepest, depth[c])
            living &= contact_a[c] == handles[x] and contact_b[c] == handles[y]
            c += 1
        before, o = o, first_of_pair(o, count, x, y, was_a, was_b, handles, row_shift)
        n = keep_sleepers(
            before, o, was_a, was_b, was_since, handles, row_shift, body_row, asleep, n, a, b, since, begins, ends
        )
        known = o < count and was_a[o] == handles[x] and was_b[o] == handles[y]
        if living and (presses or deepest >= 0.0 or (known and deepest >= -TOUCH)):
            a[n], b[n], begins[n] = handles[x], handles[y], not known
            if known:
                since[n], ends[o] = was_since[o], False
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
        q, r = was_a[o] & INDEX_MASK, was_b[o] & INDEX_MASK
        q, r = q + row_shift[q], r + row_shift[r]
        living = q < len(handles) and r < len(handles) and handles[q] == was_a[o] and handles[r] == was_b[o]
        if ends[o] and living and (sleeps(q, body_row, asleep) or sleeps(r, body_row, asleep)):
            a[n], b[n], since[n], begins[n], ends[o] = was_a[o], was_b[o], was_since[o], False, False
            n += 1
    return n


@woven
def sleeps(collider, body_row, asleep):
    """Tell whether a collider is of a body that sleeps."""
    return body_row[collider] >= 0 and asleep[body_row[collider]]
