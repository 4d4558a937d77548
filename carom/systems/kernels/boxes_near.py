"""Which colliders have boxes that meet those of a query."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels.eights import FIRST_BLOCK, LOWEST, MOST_WAITING, NOTHING
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lanes import address, larger, load, which

BARELY = 1e-300  # so that boxes that touch count


@woven
def meeting(boxes, row, lx, ly, lz, hx, hy, hz):
    """Return which of the eight boxes from ``row`` on meet the one from l to h, as bits."""
    above = larger(larger(load(boxes, row) - hx, load(boxes, row + 1) - hy), load(boxes, row + 2) - hz)
    below = larger(larger(lx - load(boxes, row + 3), ly - load(boxes, row + 4)), lz - load(boxes, row + 5))
    return which(BARELY - larger(above, below))


@kernel("pairs")
def find_near(lower, upper, takes, endless, members, tree, pairs):
    """Write (query, row) of each collider that a query's box meets; return how many, or -1 where they do not fit in.

    Colliders are those of `cast`.
    """
    boxes, leaves, inside, blocks = address(tree.boxes), address(tree.leaves), tree.inside, tree.blocks
    stack = np.empty(MOST_WAITING, np.int64)
    count = 0
    for q in range(len(lower)):
        lx, ly, lz, hx, hy, hz = lower[q, 0], lower[q, 1], lower[q, 2], upper[q, 0], upper[q, 1], upper[q, 2]
        if count + len(endless) > len(pairs):
            return -1
        for i in endless:
            if takes[i]:
                pairs[count, 0], pairs[count, 1] = q, i
                count += 1
        stack[0], waiting = 0, min(len(members), 1)
        while waiting > 0:
            waiting -= 1
            at = stack[waiting]
            if at >= 0:
                bits = meeting(boxes, 6 * at, lx, ly, lz, hx, hy, hz)
                while bits > 0:
                    held = inside[at, LOWEST[bits]]
                    bits &= bits - 1
                    if held != NOTHING:
                        stack[waiting] = held
                        waiting += 1
                continue
            block = FIRST_BLOCK - at
            bits = meeting(leaves, 6 * block, lx, ly, lz, hx, hy, hz) & ((1 << blocks[block, 1]) - 1)
            while bits > 0:
                i = members[blocks[block, 0] + LOWEST[bits]]
                bits &= bits - 1
                if not takes[i]:
                    continue
                if count == len(pairs):
                    return -1
                pairs[count, 0], pairs[count, 1] = q, i
                count += 1
    return count
