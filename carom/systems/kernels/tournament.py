"""Tournament: which pair strikes soonest, and which pairs its bodies take part in."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import making, woven


@making
def pairs_of_bodies(pairs, body_a, body_b, count):
    """Return which pairs each of ``count`` bodies takes part in: slices of one array begin at numbers of the other."""
    begin = np.zeros(count + 1, np.int64)
    for p in pairs:
        for body in (body_a[p], body_b[p]):
            if body >= 0:
                begin[body + 1] += 1
    for i in range(1, len(begin)):
        begin[i] += begin[i - 1]
    place = begin.copy()
    of_body = np.empty(begin[count], np.int64)
    for m in range(len(pairs)):
        for body in (body_a[pairs[m]], body_b[pairs[m]]):
            if body >= 0:
                of_body[place[body]] = m
                place[body] += 1
    return begin, of_body


@woven
def enter_time(soonest, leaf, time):
    """Set a leaf of the tournament and play the games above it again."""
    if soonest[leaf] == time:
        return
    soonest[leaf] = time
    while leaf > 1:
        leaf //= 2
        soonest[leaf] = min(soonest[2 * leaf], soonest[2 * leaf + 1])
