"""Which bodies joints hold within the next substep."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.bodies import surface_velocity
from carom.systems.kernels.joint_groups import KINDS, LIMIT_BIT, LINES, bound, slot
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.lanes import WIDTH
from carom.systems.kernels.spatial import turn


@kernel("touching", "held")
def mark_held(
    rows, groups, kinds, asks, h, row, index_a, index_b, first, lanes, center, rotation, linear, angular, felt,
    touching, held,
):  # fmt: skip
    """Mark both bodies of each joint as touching and held, but where a line stays within its limits for h seconds.

    Nobody else of ``rows`` is held or touches yet. Return whether lines may come to be taut or slack.
    """
    nobody, lines = len(touching), False
    for i in rows:
        held[i] = touching[i] = False
    for g in range(groups):
        may_be_slack = kinds[g] == LINES + KINDS and asks[g] == LIMIT_BIT
        lines |= may_be_slack
        for lane in range(WIDTH):
            if first[g, lane] < 0:
                continue
            a, b = index_a[g, lane], index_b[g, lane]
            a, b = a if a < nobody else -1, b if b < nobody else -1
            if may_be_slack and is_slack(row[g], lane, a, b, h, lanes, center, rotation, linear, angular, felt):
                continue
            if a >= 0:
                touching[a] = held[a] = True
            if b >= 0:
                touching[b] = held[b] = True
    return lines


@inlined
def is_slack(r, lane, a, b, h, lanes, center, rotation, linear, angular, felt):
    """Tell whether the anchors stay within the limits of their distance, however they go."""
    ax, ay, az, u, v, w, felt_a = anchor_of(r + of.LEVER_A, lane, a, lanes, center, rotation, linear, angular, felt)
    bx, by, bz, x, y, z, felt_b = anchor_of(r + of.LEVER_B, lane, b, lanes, center, rotation, linear, angular, felt)
    length = sqrt((bx - ax) ** 2 + (by - ay) ** 2 + (bz - az) ** 2)
    speed = sqrt((x - u) ** 2 + (y - v) ** 2 + (z - w) ** 2)
    way = 2.0 * h * (speed + h * (felt_a + felt_b))
    p = bound(r, 1, 0)
    locked = lanes[slot(r, 0) + of.HELD, lane] > 0.0
    return not locked and lanes[p + of.LOWER, lane] < length - way and length + way < lanes[p + of.UPPER, lane]


@inlined
def anchor_of(lever, lane, i, lanes, center, rotation, linear, angular, felt):
    """Return where an anchor of body i is, how fast it moves, and how strongly forces accelerate the body."""
    x, y, z = lanes[lever, lane], lanes[lever + 1, lane], lanes[lever + 2, lane]
    if i < 0:
        return x, y, z, 0.0, 0.0, 0.0, 0.0
    x, y, z = turn(rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3], x, y, z)
    u, v, w = surface_velocity(i, x, y, z, linear, angular)
    pull = sqrt(felt[i, 0] ** 2 + felt[i, 1] ** 2 + felt[i, 2] ** 2)
    return x + center[i, 0], y + center[i, 1], z + center[i, 2], u, v, w, pull
