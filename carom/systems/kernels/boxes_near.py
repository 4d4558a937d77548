"""Which colliders have boxes that those of queries meet or, as they move straight on, pass through."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels.eights import FIRST_BLOCK, LOWEST, MOST_WAITING, NOTHING
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lanes import address, larger, load, smaller, which
from carom.systems.kernels.ray_meshes import one_over

BARELY = 1e-300  # so that boxes that touch count


@woven
def on_way(boxes, row, x, y, z, hx, hy, hz, ix, iy, iz, limit):
    """Return which of the eight boxes from ``row`` on a box of half extents h passes through, as bits.

    Its middle begins at x and i is one over its direction: as a point it passes through boxes larger by h.
    """
    lx, ux = (load(boxes, row) - hx - x) * ix, (load(boxes, row + 3) + hx - x) * ix
    ly, uy = (load(boxes, row + 1) - hy - y) * iy, (load(boxes, row + 4) + hy - y) * iy
    lz, uz = (load(boxes, row + 2) - hz - z) * iz, (load(boxes, row + 5) + hz - z) * iz
    enter = larger(larger(smaller(lx, ux), smaller(ly, uy)), smaller(lz, uz))
    leave = smaller(smaller(larger(lx, ux), larger(ly, uy)), larger(lz, uz))
    return which(BARELY - larger(larger(enter - leave, -leave), enter - limit))


@kernel("pairs", makes_arrays=True)
def find_near(center, half, direction, reach, takes, endless, members, tree, pairs):
    """Write (query, row) where a query's box passes through a collider's; return how many, -1 if they do not fit in.

    Colliders are those of `cast`. A direction of 0 leaves a box where it is.
    """
    boxes, leaves, inside, blocks = address(tree.boxes), address(tree.leaves), tree.inside, tree.blocks
    stack = np.empty(MOST_WAITING, np.int64)
    count = 0
    for q in range(len(center)):
        x, y, z, hx, hy, hz = center[q, 0], center[q, 1], center[q, 2], half[q, 0], half[q, 1], half[q, 2]
        ix, iy, iz = one_over(direction[q, 0]), one_over(direction[q, 1]), one_over(direction[q, 2])
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
                bits = on_way(boxes, 6 * at, x, y, z, hx, hy, hz, ix, iy, iz, reach[q])
                while bits > 0:
                    held = inside[at, LOWEST[bits]]
                    bits &= bits - 1
                    if held != NOTHING:
                        stack[waiting] = held
                        waiting += 1
                continue
            block = FIRST_BLOCK - at
            bits = on_way(leaves, 6 * block, x, y, z, hx, hy, hz, ix, iy, iz, reach[q])
            bits &= (1 << blocks[block, 1]) - 1
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
