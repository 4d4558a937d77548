"""Passing: which two bodies that can both be pushed may meet, or seem to by contacts followed straight on."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.bodies import length_of
from carom.systems.kernels.fast_pairs import NEVER, between, is_one_quick
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.trust import closing_of


@woven
def nearing_of(c, i, o, point, center, linear, angular):
    """Return how fast (m/s) points of bodies i and o move against each other at most, as far out as contact c."""
    speed = between(i, o, linear, linear)
    for body in (i, o):
        if body >= 0:
            x, y, z = point[c, 0] - center[body, 0], point[c, 1] - center[body, 1], point[c, 2] - center[body, 2]
            speed += length_of(body, angular) * sqrt(x * x + y * y + z * z)
    return speed


@kernel("pairs")
def find_nearing(span, row_a, row_b, depth, point, body_row, quick, center, linear, angular, pairs):
    """Write the pairs with a ``quick`` body that do not touch and may within ``span`` seconds; return how many."""
    count, c = 0, 0
    while c < len(row_a):
        a, b, gap, first = row_a[c], row_b[c], NEVER, c
        i, o = body_row[a], body_row[b]
        if not is_one_quick(i, o, quick):  # most often
            c += 1
            continue
        while c < len(row_a) and row_a[c] == a and row_b[c] == b:
            gap, c = min(gap, -depth[c]), c + 1
        if 0.0 < gap < span * nearing_of(first, i, o, point, center, linear, angular):
            pairs[count, 0], pairs[count, 1] = a, b
            count += 1
    return count


@kernel("pairs")
def find_seeming(span, row_a, row_b, normal, depth, point, body_row, center, linear, angular, pairs):
    """Write the pairs of which a contact, followed straight on, closes within ``span`` seconds; return how many."""
    count = 0
    for c in range(len(row_a)):
        a, b = row_a[c], row_b[c]
        if depth[c] >= 0.0 or (count and pairs[count - 1, 0] == a and pairs[count - 1, 1] == b):
            continue
        if -depth[c] < span * closing_of(c, body_row[a], body_row[b], normal, point, center, linear, angular):
            pairs[count, 0], pairs[count, 1] = a, b
            count += 1
    return count
