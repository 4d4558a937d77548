"""Trees of eights: a node's eight boxes are tested at once, in lanes.

The boxes of node n are rows 6 n to 6 n + 5 of ``boxes``: lower x, y, z and upper x, y, z, each of eight. What is in
them is in ``inside``: a node, or a block of at most eight leaves, as -2 less its number; -1 is nothing.
"""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import ON_SURFACE
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lanes import WIDTH, larger, load, smaller, store, which

NOTHING, FIRST_BLOCK = -1, -2
MOST_WAITING = 512  # nodes on the way: at most seven of every level of a tree
NOWHERE = 1e300  # m, where boxes are that hold nothing
LOWEST = np.array([(bits & -bits).bit_length() - 1 for bits in range(1 << WIDTH)])  # of the bits of a number


@kernel("boxes", "inside", "blocks")
def join_in_eights(root, bounds, nodes, boxes, inside, blocks, node, block):
    """Join the binary tree at ``root`` (of `build_tree`) in eights, from ``node`` and ``block`` on; return their ends.

    Of what a node holds the largest is opened until there are eight. ``blocks`` are the first leaf and the number of
    leaves of each.
    """
    inside[node, 0] = root  # where a node begins is noted where it will be
    last = node + 1
    while node < last:
        inside[node, 1:] = NOTHING
        if nodes[3 * inside[node, 0] + 2] == 0:
            inside[node, 1] = nodes[3 * (inside[node, 0] + 1)]
            inside[node, 0] += 1
        count = 1 if inside[node, 1] == NOTHING else 2
        while count < WIDTH:
            widest, most = -1, -1.0
            for lane in range(count):
                b = 6 * inside[node, lane]
                x, y, z = bounds[b + 3] - bounds[b], bounds[b + 4] - bounds[b + 1], bounds[b + 5] - bounds[b + 2]
                if nodes[3 * inside[node, lane] + 2] == 0 and x * y + y * z + z * x > most:
                    widest, most = lane, x * y + y * z + z * x
            if widest < 0:
                break
            opened = inside[node, widest]
            inside[node, widest], inside[node, count] = opened + 1, nodes[3 * (opened + 1)]
            count += 1
        for lane in range(WIDTH):
            for k in range(6):
                boxes[6 * node + k, lane] = bounds[6 * inside[node, lane] + k] if lane < count else NOWHERE
            if lane >= count:
                continue
            held = inside[node, lane]
            if nodes[3 * held + 2] == 0:
                inside[last, 0] = held
                inside[node, lane] = last
                last += 1
            else:
                blocks[block, 0], blocks[block, 1] = nodes[3 * held + 1], nodes[3 * held + 2]
                inside[node, lane] = FIRST_BLOCK - block
                block += 1
        node += 1
    return node, block


@woven
def look_into(boxes, row, x, y, z, ix, iy, iz, start, limit, lanes):
    """Return which of the eight boxes from ``row`` on a line meets, as bits, and write into lanes where it enters each.

    i is one over its direction. Those it misses by no more than ON_SURFACE it meets.
    """
    lx, hx = (load(boxes, row) - x) * ix, (load(boxes, row + 3) - x) * ix
    ly, hy = (load(boxes, row + 1) - y) * iy, (load(boxes, row + 4) - y) * iy
    lz, hz = (load(boxes, row + 2) - z) * iz, (load(boxes, row + 5) - z) * iz
    enter = larger(larger(smaller(lx, hx), smaller(ly, hy)), smaller(lz, hz))
    leave = smaller(smaller(larger(lx, hx), larger(ly, hy)), larger(lz, hz))
    store(lanes, 0, enter)
    return which(ON_SURFACE - larger(larger(enter - leave, start - leave), enter - limit))


@woven
def push_seen(inside, node, bits, enter, stack, ahead, waiting):
    """Put what a line meets of the eight in a node on the stack, the nearest on top; return how many wait there now."""
    first = waiting
    while bits > 0:
        lane = LOWEST[bits]
        bits &= bits - 1
        if inside[node, lane] == NOTHING:
            continue
        at = waiting
        while at > first and ahead[at - 1] < enter[0, lane]:
            stack[at], ahead[at] = stack[at - 1], ahead[at - 1]
            at -= 1
        stack[at], ahead[at] = inside[node, lane], enter[0, lane]
        waiting += 1
    return waiting
