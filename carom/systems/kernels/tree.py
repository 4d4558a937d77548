"""The tree: bounds within bounds, for colliders that stand still or are of another size than most.

Nodes lie in the order in which a walk meets them: behind each is its first half, and ``skip`` names the node behind all
it holds. Members of one size class stay together; within it halves are split at the median.
"""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined, kernel

LEAF = 4  # members at most in a node without halves
WAITING = 2048  # halves on the way down to a leaf at most: size classes of float64, and bits of a row number


@inlined
def part_at(members, low, high, middle, axis, fat_lower, fat_upper):
    """Reorder members from low to high so that none before ``middle`` has a centre beyond any from there on."""
    high -= 1
    while low < high:
        pivot = members[(low + high) >> 1]
        value = fat_lower[pivot, axis] + fat_upper[pivot, axis]
        left, right = low, high
        while left <= right:
            while fat_lower[members[left], axis] + fat_upper[members[left], axis] < value:
                left += 1
            while fat_lower[members[right], axis] + fat_upper[members[right], axis] > value:
                right -= 1
            if left <= right:
                members[left], members[right] = members[right], members[left]
                left += 1
                right -= 1
        if middle <= right:
            high = right
        elif middle >= left:
            low = left
        else:
            return


@kernel("members", "bounds", "span", "skip", "moves")
def grow_tree(kind, body_row, fat_lower, fat_upper, members, bounds, span, skip, moves):
    """Build the tree over ``members``, given in order of their size class ``kind``; return how many nodes it has.

    A node's members are ``members[span[node, 0]:span[node, 1]]``, ``moves`` tells whether one of them is a body's.
    """
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
            axis, widest = 0, -1.0
            for k in range(3):
                least, most = np.inf, -np.inf
                for m in range(low, high):
                    center = fat_lower[members[m], k] + fat_upper[members[m], k]
                    least, most = min(least, center), max(most, center)
                if most - least > widest:
                    axis, widest = k, most - least
            part_at(members, low, high, middle, axis, fat_lower, fat_upper)
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
