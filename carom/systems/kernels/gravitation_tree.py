"""Gravitation by a tree: bodies far away pull as one, with their second moments.

J. Barnes and P. Hut, A hierarchical O(N log N) force-calculation algorithm, Nature 324, 1986. Theirs has eight cells in
each; here each has two, parted where the widest axis is halved but by whole leaves of eight bodies: a leaf goes through
the tree as the lanes of one vector. Nodes stand in preorder: behind each its first half, and behind that the other. One
that has the leaves ``a`` to ``b`` is ``2 (b - a) - 1`` nodes, itself included.
"""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.kernel import inlined, kernel, woven
from carom.systems.kernels.lane_vectors import TINY
from carom.systems.kernels.lanes import WIDTH, address, choose, load, root, some, spread, store
from carom.systems.kernels.selection import select, widest_axis

PART = 8  # a half has this part of the leaves at least, however few bodies are on its side
DEEPEST = 256  # halves on the way down to a leaf at most: a node has up to 7/8 of the leaves of the one above it
# A node is its centre of mass, its mass, m d d summed (xx, xy, xz, yy, yz, zz; d from the centre of mass), bounds, and
# the square of their widest extent.
MASS, SECOND, LOWER, UPPER, EXTENT, NODE = 3, 4, 10, 13, 16, 17


@kernel("order", "span", "nodes", makes_arrays=True)
def grow_gravity_tree(mass, center, order, span, nodes):
    """Sort bodies into the tree, ``order`` naming them in its order; ``span`` (m, 2) is which leaves a node has."""
    count = len(order)
    todo = np.empty((DEEPEST, 2), np.int64)
    todo[0, 0], todo[0, 1] = 0, (count + WIDTH - 1) // WIDTH
    waiting, node = 1, 0
    while waiting > 0:
        waiting -= 1
        a, b = todo[waiting, 0], todo[waiting, 1]
        span[node, 0], span[node, 1] = a, b
        node += 1
        if b - a > 1:
            first, last = WIDTH * a, min(WIDTH * b, count)
            axis = widest_axis(order, center, first, last)
            half = a + leaves_below(order, center, axis, first, last, b - a)
            select(order, center, axis, first, last, WIDTH * half)
            todo[waiting, 0], todo[waiting, 1] = half, b
            todo[waiting + 1, 0], todo[waiting + 1, 1] = a, half
            waiting += 2
    for node in range(len(span) - 1, -1, -1):
        a, b = span[node, 0], span[node, 1]
        for k in range(NODE):
            nodes[node, k] = 0.0
        for k in range(3):
            nodes[node, LOWER + k], nodes[node, UPPER + k] = np.inf, -np.inf
        nodes[node, EXTENT] = TINY  # so that nobody is far enough from where it is
        if b - a == 1:
            for n in range(WIDTH * a, min(WIDTH * b, count)):
                i = order[n]
                nodes[node, MASS] += mass[i]
                for k in range(3):
                    nodes[node, k] += mass[i] * center[i, k]
                    nodes[node, LOWER + k] = min(nodes[node, LOWER + k], center[i, k])
                    nodes[node, UPPER + k] = max(nodes[node, UPPER + k], center[i, k])
            find_center(node, nodes)
            for n in range(WIDTH * a, min(WIDTH * b, count)):
                i = order[n]
                add_moments(node, mass[i], center[i, 0], center[i, 1], center[i, 2], nodes)
        else:
            one, other = node + 1, node + 2 * (span[node + 1, 1] - a)
            for part in (one, other):
                nodes[node, MASS] += nodes[part, MASS]
                for k in range(3):
                    nodes[node, k] += nodes[part, MASS] * nodes[part, k]
                    nodes[node, LOWER + k] = min(nodes[node, LOWER + k], nodes[part, LOWER + k])
                    nodes[node, UPPER + k] = max(nodes[node, UPPER + k], nodes[part, UPPER + k])
            find_center(node, nodes)
            for part in (one, other):
                add_moments(node, nodes[part, MASS], nodes[part, 0], nodes[part, 1], nodes[part, 2], nodes)
                for k in range(6):
                    nodes[node, SECOND + k] += nodes[part, SECOND + k]
        for k in range(3):
            wide = nodes[node, UPPER + k] - nodes[node, LOWER + k]
            nodes[node, EXTENT] = max(nodes[node, EXTENT], wide * wide)


@inlined
def leaves_below(order, center, axis, first, last, leaves):
    """Return how many leaves go below the middle of an axis: as many as hold the bodies there, of both halves some."""
    low, high = np.inf, -np.inf
    for n in range(first, last):
        low, high = min(low, center[order[n], axis]), max(high, center[order[n], axis])
    middle, below = 0.5 * (low + high), 0
    for n in range(first, last):
        below += center[order[n], axis] < middle
    least = max(1, leaves // PART)
    return min(max((below + WIDTH // 2) // WIDTH, least), leaves - least)


@woven
def find_center(node, nodes):
    """Divide the sum of m x by the mass; without mass it is the middle of the bounds."""
    for k in range(3):
        if nodes[node, MASS] > 0.0:
            nodes[node, k] /= nodes[node, MASS]
        else:
            nodes[node, k] = 0.5 * (nodes[node, LOWER + k] + nodes[node, UPPER + k])


@woven
def add_moments(node, mass, x, y, z, nodes):
    """Add m d d of a part, d from the centre of mass of the node."""
    dx, dy, dz = x - nodes[node, 0], y - nodes[node, 1], z - nodes[node, 2]
    for k, product in enumerate((dx * dx, dx * dy, dx * dz, dy * dy, dy * dz, dz * dz)):
        nodes[node, SECOND + k] += mass * product


@shared("pull", "energy", makes_arrays=True)
def sum_tree(crew, mass, center, constant, softening, opening, order, span, nodes, pull, energy):
    """Write the pulls (n, 3) on the bodies of leaves, and their shares of the energy (n,).

    A node whose extent is at most ``opening`` times how far its centre of mass is from each body pulls as one: as the
    softened points in it do to the second order of their distances from that centre. Others are opened, and the bodies
    of leaves pull one by one.
    """
    count = len(order)
    begin, end = part_of(crew, (count + WIDTH - 1) // WIDTH)
    bodies, sums = np.zeros((4, WIDTH)), np.zeros((4, WIDTH))
    at, into = address(bodies), address(sums)
    soft, sharpness, zero, one = softening * softening, opening * opening, spread(0.0), spread(1.0)
    for own in range(len(span)):
        leaf = span[own, 0]
        if span[own, 1] - leaf > 1 or leaf < begin or leaf >= end:
            continue
        first, last = WIDTH * leaf, min(WIDTH * leaf + WIDTH, count)
        for lane in range(WIDTH):
            i = order[min(first + lane, last - 1)]
            for k in range(3):
                bodies[k, lane] = center[i, k]
        x, y, z = load(at, 0), load(at, 1), load(at, 2)
        ax, ay, az, depth = zero, zero, zero, zero
        node = 0
        while node < len(span):
            a, b = span[node, 0], span[node, 1]
            cx, cy, cz = nodes[node, 0], nodes[node, 1], nodes[node, 2]
            dx, dy, dz = cx - x, cy - y, cz - z
            squared = dx * dx + dy * dy + dz * dz
            if not some(nodes[node, EXTENT] - sharpness * squared):
                inverse = 1.0 / (squared + soft)
                near = root(inverse)
                cube = near * inverse
                xx, xy, xz = nodes[node, SECOND], nodes[node, SECOND + 1], nodes[node, SECOND + 2]
                yy, yz, zz = nodes[node, SECOND + 3], nodes[node, SECOND + 4], nodes[node, SECOND + 5]
                sx, sy, sz = dx * xx + dy * xy + dz * xz, dx * xy + dy * yy + dz * yz, dx * xz + dy * yz + dz * zz
                along, trace = (dx * sx + dy * sy + dz * sz) * inverse, xx + yy + zz
                fifth, heavy = cube * inverse, nodes[node, MASS]
                strength = heavy * cube + (7.5 * along - 1.5 * trace) * fifth
                three = 3.0 * fifth
                ax, ay, az = (
                    ax + dx * strength - sx * three,
                    ay + dy * strength - sy * three,
                    az + dz * strength - sz * three,
                )
                depth = depth + near * heavy + (1.5 * along - 0.5 * trace) * cube
                node += 2 * (b - a) - 1
                continue
            for n in range(WIDTH * a, min(WIDTH * b, count) if b - a == 1 else 0):
                j = order[n]
                dx, dy, dz = center[j, 0] - x, center[j, 1] - y, center[j, 2] - z
                squared = dx * dx + dy * dy + dz * dz + soft
                apart = choose(squared, squared, one)
                strength = mass[j] / (apart * root(apart))
                ax = ax + strength * dx
                ay = ay + strength * dy
                az = az + strength * dz
                depth = depth + strength * squared
            node += 1
        store(into, 0, ax)
        store(into, 1, ay)
        store(into, 2, az)
        store(into, 3, depth)
        for n in range(first, last):
            i = order[n]
            for k in range(3):
                pull[i, k] = constant * mass[i] * sums[k, n - first]
            itself = mass[i] / softening if softening > 0.0 else 0.0  # it was among its leaf
            energy[i] = -0.5 * constant * mass[i] * (sums[3, n - first] - itself)


@kernel("pull")
def take_drift(mass, pull):
    """Take from all alike the acceleration that the errors of their pulls (n, 3) would give them together."""
    total, x, y, z = 0.0, 0.0, 0.0, 0.0
    for i in range(len(mass)):
        total, x, y, z = total + mass[i], x + pull[i, 0], y + pull[i, 1], z + pull[i, 2]
    for i in range(len(mass)):
        for k, drift in enumerate((x, y, z)):
            pull[i, k] -= mass[i] / total * drift
