"""Broad phase: candidates become sorted pairs, and pairs found anew take the place of those of their rows."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import kernel


@kernel("candidates", "scratch", "pairs", makes_arrays=True)
def order_pairs(candidates, used, known, scratch, pairs):
    """Write the candidates that may be pairs at all, lower row first, sorted; return their count.

    They are of two bodies, each on a layer that the other accepts, and not both sensors or both moved by nothing.
    Counting sort by the higher row, then by the lower: one row with thousands of pairs costs no more.
    """
    at_low, at_high = np.zeros(used + 1, np.int64), np.zeros(used + 1, np.int64)
    count = 0
    for c in range(len(candidates)):
        i, j = candidates[c, 0], candidates[c, 1]
        if (
            known[i, 0] != known[j, 0] and (known[i, 2] & known[j, 1]) != 0 and (known[j, 2] & known[i, 1]) != 0
            and (known[i, 3] & known[j, 3]) == 0
        ):  # fmt: skip
            low, high = min(i, j), max(i, j)
            candidates[count, 0], candidates[count, 1] = low, high
            at_low[low + 1] += 1
            at_high[high + 1] += 1
            count += 1
    for i in range(used):
        at_low[i + 1] += at_low[i]
        at_high[i + 1] += at_high[i]
    for c in range(count):
        high = candidates[c, 1]
        scratch[at_high[high], 0], scratch[at_high[high], 1] = candidates[c, 0], high
        at_high[high] += 1
    for c in range(count):
        low = scratch[c, 0]
        pairs[at_low[low], 0], pairs[at_low[low], 1] = low, scratch[c, 1]
        at_low[low] += 1
    return count


@kernel("pairs", makes_arrays=True)
def renew_pairs(old, new, leavers, used, pairs):
    """Merge the pairs that no leaver is in with those found anew; both are sorted. Return their count.

    All rows are among those ``used``.
    """
    leaves = np.zeros(used, np.bool_)
    for i in leavers:
        leaves[i] = True
    count, n = 0, 0
    for o in range(len(old)):
        i, j = old[o, 0], old[o, 1]
        if leaves[i] or leaves[j]:
            continue
        while n < len(new) and (new[n, 0] < i or (new[n, 0] == i and new[n, 1] < j)):
            pairs[count, 0], pairs[count, 1] = new[n, 0], new[n, 1]
            count, n = count + 1, n + 1
        pairs[count, 0], pairs[count, 1] = i, j
        count += 1
    while n < len(new):
        pairs[count, 0], pairs[count, 1] = new[n, 0], new[n, 1]
        count, n = count + 1, n + 1
    return count


@kernel("found")
def pairs_of(pairs, body_row, leaves, found):
    """Write the pairs of which a body leaves, and return their count."""
    count = 0
    for p in range(len(pairs)):
        a, b = body_row[pairs[p, 0]], body_row[pairs[p, 1]]
        if (a >= 0 and leaves[a]) or (b >= 0 and leaves[b]):
            found[count, 0], found[count, 1] = pairs[p, 0], pairs[p, 1]
            count += 1
    return count
