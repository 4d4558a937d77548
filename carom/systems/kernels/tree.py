"""The tree: bounds within bounds, for colliders that stand still or are of another size than most.

Nodes lie in the order in which a walk meets them: behind each is its first half, and ``skip`` names the node behind all
it holds. Members of one size class stay together; within it halves are split at the median.
"""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.selection import select, widest_axis

LEAF = 4  # members at most in a node without halves
WAITING = 2048  # halves on the way down to a leaf at most: size classes of float64, and bits of a row number


@kernel("members", "bounds", "span", "skip", "moves", makes_arrays=True)
def grow_tree(kind, body_row, fat_lower, fat_upper, members, bounds, span, skip, moves):
    """Build the tree over ``members``, given in order of their size class ``kind``; return how many nodes it has.

    A node's members are ``members[span[node, 0]:span[node, 1]]``, ``moves`` tells whether one of them is a body's.
    """
    center = np.empty(fat_lower.shape)
    for m in members:
        for k in range(3):
            center[m, k] = fat_lower[m, k] + fat_upper[m, k]  # twice that
    todo = np.empty((WAITING, 2), np.int64)
    todo[0, 0], todo[0, 1] = 0, len(members)
    waiting, nodes = min(len(members), 1), 0
    while waiting > 0:
        waiting -= 1
        low, high = todo[waiting, 0], todo[waiting, 1]
        span[nodes, 0], span[nodes, 1] = low, high
        nodes += 1
        skip[nodes - 1] = nodes
        if high - low <= LEAF and kind[low] == kind[high - 1]:
            continue
        skip[nodes - 1] = 0  # has halves
        middle = (low + high) >> 1
        if kind[low] != kind[high - 1]:
            middle = low + 1
            while kind[middle] == kind[low]:
                middle += 1
        else:
            select(members, center, widest_axis(members, center, low, high), low, high, middle)
        todo[waiting, 0], todo[waiting, 1] = middle, high
        todo[waiting + 1, 0], todo[waiting + 1, 1] = low, middle
        waiting += 2
    for node in range(nodes - 1, -1, -1):
        moves[node] = False
        for k in range(3):
            bounds[node, k], bounds[node, 3 + k] = np.inf, -np.inf
        if skip[node] == 0:
            second = skip[node + 1]
            skip[node] = skip[second]
            moves[node] = moves[node + 1] or moves[second]
            for k in range(3):
                bounds[node, k] = min(bounds[node + 1, k], bounds[second, k])
                bounds[node, 3 + k] = max(bounds[node + 1, 3 + k], bounds[second, 3 + k])
        else:
            for m in range(span[node, 0], span[node, 1]):
                i = members[m]
                moves[node] |= body_row[i] >= 0
                for k in range(3):
                    bounds[node, k] = min(bounds[node, k], fat_lower[i, k])
                    bounds[node, 3 + k] = max(bounds[node, 3 + k], fat_upper[i, k])
    return nodes
