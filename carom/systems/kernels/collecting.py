"""Collecting: the points of all pairs are put in order, whoever measured them, without what no contact may be."""

from __future__ import annotations

from math import inf

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import MEASURED
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.narrow import FCLS, PLANE_SHAPE, SWAPPED
from carom.systems.kernels.validity import SOUND, fault_of, greatest_depth, radius_about


@kernel()
def count_points(count, gaps):
    """Return how many points pairs have, and how many pairs have none and are known to be some way apart (m)."""
    points, apart = 0, 0
    for p in range(len(count)):
        points += count[p]
        apart += count[p] == 0 and gaps[p] > 0.0
    return points, apart


@woven
def find_measured(begin, end, count, found):
    """Write which pairs, from ``begin`` to ``end``, have points; return how many they are.

    Which they are is past foreseeing, so that no branch hangs on it, here or where the pairs are gone through.
    """
    number = 0
    for p in range(begin, end):
        found[number] = p
        number += 1 if count[p] else 0
    return number


@shared(
    "row_a", "row_b", "found_feature", "found_normal", "found_depth", "found_point", "by_fcl", "old", "told",
    "received", makes_arrays=True,
)  # fmt: skip
def collect_points(
    crew, pairs, reaches, side, shape, size, local, bound_center, bound_half, bound_radius, position, rotation,
    start, count, feature, normal, depth, point,
    row_a, row_b, found_feature, found_normal, found_depth, found_point, by_fcl, old, told, received,
):  # fmt: skip
    """Put the sound points of all pairs in order of pair and feature, with normals from the lower row to the other.

    None of them is an ``old`` one. Each thread has a row of ``told``: from where to where its points are, as those of
    the next begin where they would if none were left out; and the first pair of which one was, and what is wrong with
    that. It was ``received``, as is the end of what is accepted.
    """
    first_pair, end_pair = part_of(crew, len(pairs))
    at = 0
    for p in range(first_pair):
        at += count[p]
    told[crew[1], 0] = at
    measured = np.empty(end_pair - first_pair, np.int64)
    for p in measured[: find_measured(first_pair, end_pair, count, measured)]:
        a, b = pairs[p, 0], pairs[p, 1]
        deepest, farthest = inf, (1.0 + MEASURED) * reaches[p] + MEASURED
        greatest = 0.0
        for source in range(start[p], start[p] + count[p]):
            greatest = max(greatest, depth[source])
        small = bound_radius[a] + bound_half[a, 0] + bound_radius[b] + bound_half[b, 0]  # less than both balls
        if greatest > (0.0 if shape[a] == PLANE_SHAPE or shape[b] == PLANE_SHAPE else small):
            ball_a = radius_about(a, local, bound_center, bound_half, bound_radius)
            ball_b = radius_about(b, local, bound_center, bound_half, bound_radius)
            deepest = greatest_depth(a, b, ball_a, ball_b, shape, size, position, rotation)
            deepest = (1.0 + MEASURED) * deepest + MEASURED
        begin, sense, fcl = at, -1.0 if side[p] == SWAPPED else 1.0, side[p] == FCLS
        for source in range(start[p], start[p] + count[p]):
            nx, ny, nz = normal[source, 0], normal[source, 1], normal[source, 2]
            x, y, z = point[source, 0], point[source, 1], point[source, 2]
            wrong, what, accepted = fault_of(nx, ny, nz, depth[source], x, y, z, deepest, farthest)
            if wrong != SOUND:
                if told[crew[1], 3] == SOUND:
                    told[crew[1], 2], told[crew[1], 3] = p, wrong
                    received[crew[1], 0], received[crew[1], 1] = what, accepted
                continue
            c = at
            while c > begin and found_feature[c - 1] > feature[source]:  # few: sorted as they come
                found_feature[c], found_depth[c] = found_feature[c - 1], found_depth[c - 1]
                for d in range(3):
                    found_normal[c, d], found_point[c, d] = found_normal[c - 1, d], found_point[c - 1, d]
                c -= 1
            found_feature[c], found_depth[c] = feature[source], depth[source]
            found_normal[c, 0], found_normal[c, 1], found_normal[c, 2] = sense * nx, sense * ny, sense * nz
            found_point[c, 0], found_point[c, 1], found_point[c, 2] = x, y, z
            row_a[at], row_b[at], by_fcl[at], old[at] = a, b, fcl, -1
            at += 1
    told[crew[1], 1] = at
