"""Apart: pairs that are known to be farther from each other than they reach, by how far they have come since."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APART_MARGIN, REACH_KEPT
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.narrow import is_ball
from carom.systems.kernels.rows import first_at


@shared("seen", "way")
def add_ways(crew, rows, bound_center, bound_half, bound_radius, position, rotation, seen, way):
    """Add to the ``way`` (m) of colliders what no point of theirs has gone beyond since they were ``seen``; see them.

    One at the distance r from the origin of a collider that turns from q to p goes no farther than 2 r |p - q|.
    """
    begin, end = part_of(crew, len(rows))
    for i in rows[begin:end]:
        moved, turned, other, center, half = 0.0, 0.0, 0.0, 0.0, 0.0
        for k in range(3):
            moved += (position[i, k] - seen[i, k]) ** 2
            center += bound_center[i, k] * bound_center[i, k]
            half += bound_half[i, k] * bound_half[i, k]
            seen[i, k] = position[i, k]
        for k in range(4):
            turned += (rotation[i, k] - seen[i, 3 + k]) ** 2
            other += (rotation[i, k] + seen[i, 3 + k]) ** 2
            seen[i, 3 + k] = rotation[i, k]
        if moved > 0.0 or turned > 0.0:
            radius = sqrt(center) + sqrt(half) + bound_radius[i]
            way[i] += sqrt(moved) + 2.0 * radius * sqrt(min(turned, other))


@kernel("near", "near_reaches")
def leave_apart(pairs, reaches, until, way, shape, near, near_reaches):
    """Write the pairs that may be within their reaches (m), and these; return how many they are.

    The others have ``until`` their ways make up that much less what they reach, of balls what contacts leave at
    (REACH_KEPT). Who these are is past foreseeing, so that no branch hangs on it.
    """
    count = 0
    for p in range(len(pairs)):
        i, j = pairs[p, 0], pairs[p, 1]
        near[count, 0], near[count, 1], near_reaches[count] = i, j, reaches[p]
        leaves = REACH_KEPT if is_ball(i, shape) or is_ball(j, shape) else 1.0
        count += 0 if until[p] - way[i] - way[j] > leaves * reaches[p] else 1
    return count


@shared("until")
def note_apart(crew, measured, gaps, pairs, way, until):
    """Write ``until`` when measured pairs stay apart of which a gap above 0 (m) is known.

    Both lists of pairs are sorted, and those measured are among the others.
    """
    begin, end = part_of(crew, len(measured))
    p = first_at(pairs[:, 0], pairs[:, 1], measured[begin, 0], measured[begin, 1]) if begin < end else 0
    for m in range(begin, end):
        i, j = measured[m, 0], measured[m, 1]
        while pairs[p, 0] != i or pairs[p, 1] != j:
            p += 1
        if gaps[m] > 0.0:
            until[p] = (1.0 - APART_MARGIN) * gaps[m] + way[i] + way[j]


@shared("until")
def keep_apart(crew, old, old_until, pairs, until):
    """Write of pairs until when they stay apart, as was known of the ``old`` ones; both lists are sorted."""
    begin, end = part_of(crew, len(pairs))
    o = first_at(old[:, 0], old[:, 1], pairs[begin, 0], pairs[begin, 1]) if begin < end else 0
    for p in range(begin, end):
        i, j = pairs[p, 0], pairs[p, 1]
        while o < len(old) and (old[o, 0] < i or (old[o, 0] == i and old[o, 1] < j)):
            o += 1
        known = o < len(old) and old[o, 0] == i and old[o, 1] == j
        until[p] = old_until[o] if known else -np.inf
