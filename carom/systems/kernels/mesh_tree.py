"""The tree of boxes over a mesh's triangles: built by halves, and searched without a stack."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.frames import turned_back
from carom.systems.kernels.kernel import inlined, kernel, making, woven
from carom.systems.kernels.selection import select, widest_axis

LEAF = 8  # triangles at most
DEPTH = 64  # halvings of any number there is
FEW = 256  # triangles and points there is room for at first
TRIANGLE = 15  # numbers per triangle: corners, unit normal, one over the length of each edge


@kernel("order", "bounds", "nodes", makes_arrays=True)
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
        nodes[3 * count + 1], nodes[3 * count + 2] = first, last - first if last - first <= LEAF else 0
        count += 1
        if last - first > LEAF:
            half = first + (last - first) // 2
            select(order, middle, widest_axis(order, middle, first, last), first, last, half)
            stack[waiting, 0], stack[waiting, 1] = half, last
            stack[waiting + 1, 0], stack[waiting + 1, 1] = first, half
            waiting += 2
    for node in range(count - 1, -1, -1):
        b, left = 6 * node, 6 * (node + 1)
        nodes[3 * node] = node + 1
        if nodes[3 * node + 2] == 0:
            nodes[3 * node] = nodes[3 * nodes[3 * (node + 1)]]
            right = 6 * nodes[3 * (node + 1)]
            for d in range(3):
                bounds[b + d] = min(bounds[left + d], bounds[right + d])
                bounds[b + 3 + d] = max(bounds[left + 3 + d], bounds[right + 3 + d])
            continue
        for d in range(3):
            bounds[b + d], bounds[b + 3 + d] = 1e300, -1e300
        for k in range(nodes[3 * node + 1], nodes[3 * node + 1] + nodes[3 * node + 2]):
            for d in range(3):
                bounds[b + d] = min(bounds[b + d], lower[order[k], d])
                bounds[b + 3 + d] = max(bounds[b + 3 + d], upper[order[k], d])
    return count


@woven
def find_triangles(root, bounds, nodes, triangles, lx, ly, lz, hx, hy, hz, found):
    """Write the triangles whose bounds meet the box from l to h; return how many, maybe more than there is room for.

    ``found`` has no signs, so that nobody tests whether one is an index from the end: a tenth of the time.
    """
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


@making
def all_triangles(root, bounds, nodes, triangles, lx, ly, lz, hx, hy, hz, found):
    """Return how many triangles' bounds meet the box from l to h, and ``found`` with them, grown where it must."""
    while True:
        near = find_triangles(root, bounds, nodes, triangles, lx, ly, lz, hx, hy, hz, found)
        if near <= len(found):
            return near, found
        found = grown(found)


@making
def triangles_around(root, bounds, nodes, triangles, position, rotation, x, y, z, wide, found):
    """Return what `all_triangles` does, as near as ``wide`` (m) along each axis to a place in the world.

    The mesh is at the first position and rotation.
    """
    x, y, z = turned_back(rotation, 0, x - position[0, 0], y - position[0, 1], z - position[0, 2])
    return all_triangles(
        root, bounds, nodes, triangles, x - wide, y - wide, z - wide, x + wide, y + wide, z + wide, found
    )  # fmt: skip


@inlined
def put_triangle(t, triangles, room):
    """Write the corners of a triangle into the last three vertices that there is ``room`` for."""
    for k in range(9):
        room[len(room) - 3 + k // 3, k % 3] = triangles[TRIANGLE * t + k]


@making
def grown(values):
    """Return a copy with twice the room."""
    wider = np.empty(2 * len(values), values.dtype)
    for k in range(len(values)):
        wider[k] = values[k]
    return wider
