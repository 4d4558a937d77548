"""The tree of boxes over a mesh's triangles: built by halves, and searched without a stack."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined, kernel, woven

LEAF = 8  # triangles at most
DEPTH = 64  # halvings of any number there is
TRIANGLE = 15  # numbers per triangle: corners, unit normal, one over the length of each edge


@kernel("order", "bounds", "nodes")
def build_tree(lower, upper, middle, order, bounds, nodes):
    """Sort triangles into a tree, ``order`` naming them in its order; return how many nodes it has.

    Each node is split at the median of its longest axis (Ericson, Real-Time Collision Detection, 6.2.1), so that a
    tree of n is log n deep whatever the mesh. Nodes stand in preorder and name the next that is not below them.
    """
    stack = np.empty((DEPTH, 2), np.int64)
    stack[0, 0], stack[0, 1] = 0, len(order)
    waiting, count = 1, 0
    while waiting > 0:
        waiting -= 1
        first, last = stack[waiting, 0], stack[waiting, 1]
        widest, axis = -1.0, 0
        for d in range(3):
            low, high, least, most = 1e300, -1e300, 1e300, -1e300
            for k in range(first, last):
                t = order[k]
                low, high = min(low, lower[t, d]), max(high, upper[t, d])
                least, most = min(least, middle[t, d]), max(most, middle[t, d])
            bounds[6 * count + d], bounds[6 * count + 3 + d] = low, high
            if most - least > widest:
                widest, axis = most - least, d
        nodes[3 * count + 1], nodes[3 * count + 2] = first, last - first if last - first <= LEAF else 0
        count += 1
        if last - first > LEAF:
            half = first + (last - first) // 2
            select(order, middle, axis, first, last - 1, half)
            stack[waiting, 0], stack[waiting, 1] = half, last
            stack[waiting + 1, 0], stack[waiting + 1, 1] = first, half
            waiting += 2
    for node in range(count - 1, -1, -1):
        nodes[3 * node] = node + 1
        if nodes[3 * node + 2] == 0:
            nodes[3 * node] = nodes[3 * nodes[3 * (node + 1)]]
    return count


@inlined
def select(order, middle, axis, first, last, wanted):
    """Move the entries of ``order`` from first to last so that ``wanted`` parts the lower from the higher.

    Hoare's FIND (Communications of the ACM 4, 321, 1961).
    """
    while first < last:
        pivot = middle[order[(first + last) // 2], axis]
        i, j = first, last
        while i <= j:
            while middle[order[i], axis] < pivot:
                i += 1
            while middle[order[j], axis] > pivot:
                j -= 1
            if i <= j:
                order[i], order[j] = order[j], order[i]
                i, j = i + 1, j - 1
        if wanted <= j:
            last = j
        elif wanted >= i:
            first = i
        else:
            return


@woven
def find_triangles(root, bounds, nodes, triangles, lx, ly, lz, hx, hy, hz, found):
    """Write the triangles whose bounds meet the box from l to h; return how many, maybe more than there is room for."""
    count, node, end = 0, root, nodes[3 * root]
    while node < end:
        b, n = 6 * node, 3 * node
        # One branch for all six: which of them is the first to fail is past foreseeing, and a wrong guess costs more.
        if (
            (bounds[b] > hx) | (bounds[b + 1] > hy) | (bounds[b + 2] > hz)
            | (bounds[b + 3] < lx) | (bounds[b + 4] < ly) | (bounds[b + 5] < lz)
        ):  # fmt: skip
            node = nodes[n]
            continue
        for t in range(nodes[n + 1], nodes[n + 1] + nodes[n + 2]):
            k = TRIANGLE * t
            if count < len(found):
                found[count] = t
            ax, ay, az = triangles[k], triangles[k + 1], triangles[k + 2]
            bx, by, bz = triangles[k + 3], triangles[k + 4], triangles[k + 5]
            cx, cy, cz = triangles[k + 6], triangles[k + 7], triangles[k + 8]
            apart = (
                (min(ax, bx, cx) > hx) | (min(ay, by, cy) > hy) | (min(az, bz, cz) > hz)
                | (max(ax, bx, cx) < lx) | (max(ay, by, cy) < ly) | (max(az, bz, cz) < lz)
            )  # fmt: skip
            count += 0 if apart else 1
        node += 1
    return count
