"""Trees that rays look through, eight boxes and eight leaves at a time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.systems.constants import ON_SURFACE
from carom.systems.detection.meshes import Meshes
from carom.systems.kernels.eights import NOTHING, join_in_eights
from carom.systems.kernels.lanes import WIDTH, aligned
from carom.systems.kernels.mesh_tree import TRIANGLE, build_tree


class Eights(NamedTuple):
    """See `kernels.eights`; the tree of geometry g has the root ``root[g]``, -1 where there is none."""

    root: Integers
    boxes: Floats
    inside: Integers
    blocks: Integers
    leaves: Floats  # as many rows of eight per block as a leaf has numbers


def over_boxes(lower: Floats, upper: Floats) -> tuple[Eights, Integers]:
    """Return the tree over boxes (n, 3), whose leaves are the boxes again, and the order of its leaves."""
    order = np.arange(len(lower))
    bounds, nodes = np.empty(12 * len(lower)), np.empty(6 * len(lower), np.int64)
    lower, upper = lower - ON_SURFACE, upper + ON_SURFACE  # for rays along a face
    count = build_tree(lower, upper, lower + upper, order, bounds, nodes) if len(lower) else 0
    leaves = np.concatenate([lower[order], upper[order]], axis=1)
    return joined(np.zeros(min(count, 1), np.int64), bounds, nodes[: 3 * count], leaves), order


def over_meshes(meshes: Meshes) -> Eights:
    """Return the trees over all triangles, whose leaves are their corners."""
    corners = meshes.triangles.reshape(-1, TRIANGLE)[:, :9]
    bounds = meshes.bounds.reshape(-1, 6) + ON_SURFACE * np.array([-1.0, -1.0, -1.0, 1.0, 1.0, 1.0])
    return joined(meshes.root, bounds.ravel(), meshes.nodes.astype(np.int64), corners)


def joined(root: Integers, bounds: Floats, nodes: Integers, values: Floats) -> Eights:
    """Return binary trees joined in eights, with the numbers ``values`` (n, width) of their leaves."""
    most = len(nodes) // 3 + 1
    boxes, inside, blocks = aligned(6 * most, WIDTH), np.full((most, WIDTH), NOTHING), np.zeros((most, 2), np.int64)
    roots, node, block = np.full(len(root), NOTHING), 0, 0
    for number in np.nonzero(root >= 0)[0].tolist():
        roots[number] = node
        node, block = join_in_eights(int(root[number]), bounds, nodes, boxes, inside, blocks, node, block)
    first, count = blocks[:block, :1], blocks[:block, 1:]
    lane, width = np.arange(WIDTH), values.shape[1]
    leaves = aligned(max(width * block, 1), WIDTH)
    if block:
        held = np.where((lane < count)[:, :, None], values[np.minimum(first + lane, len(values) - 1)], 0.0)
        leaves[:] = held.transpose(0, 2, 1).reshape(-1, WIDTH)
    return Eights(roots, boxes, inside, blocks, leaves)
