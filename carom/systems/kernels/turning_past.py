"""Turning: what bodies come to by turning alone, and what they only turn past."""

from __future__ import annotations

from math import cos, sin, sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import FAST, REACH_SLACK
from carom.systems.kernels.fast_pairs import NEVER, extent_of
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.narrow import reach_of_pair
from carom.systems.kernels.spatial import cross

LOOKS = 8  # at a point on its way around, which is a quarter of a percent of its distance off between them at 1 rad


@kernel("reaches")
def reach_turning(pairs, bound_half, bound_radius, turning, body_row, inverse_mass, reaches):
    """Let pairs reach as far as turning takes points of them, too; tell whether that is farther for any.

    It is no farther than those come who are not looked after.
    """
    some = False
    for p in range(len(pairs)):
        a, b = pairs[p, 0], pairs[p, 1]
        turned = turning[a] + turning[b]
        if turned <= REACH_SLACK:  # most often
            continue
        reach, smallest = reaches[p] + turned, NEVER
        for c in (a, b):
            if body_row[c] >= 0 and inverse_mass[body_row[c]] > 0.0:
                smallest = min(smallest, extent_of(c, bound_half, bound_radius))
        reach = min(reach, FAST * smallest)
        if reach > reaches[p]:
            reaches[p], some = reach, True
    return some


@kernel("past")
def find_turning_past(
    span, row_a, row_b, normal, depth, point, old, body_row, reach, asleep, passes, center, angular, past
):
    """Say which contacts that bodies do not reach but by turning turn ``past`` within ``span`` seconds; count them.

    Those recycled (``old`` is not below 0) were known before.
    """
    count = 0
    for c in range(len(row_a)):
        a, b = row_a[c], row_b[c]
        beyond = -depth[c] - reach_of_pair(a, b, body_row, reach, asleep, passes)
        past[c] = old[c] < 0 and beyond > 0.0
        for look in range(1, LOOKS + 1 if past[c] else 1):
            time = span * look / LOOKS
            risen = risen_by(c, body_row[a], time, normal, point, center, angular)
            past[c] = past[c] and risen - risen_by(c, body_row[b], time, normal, point, center, angular) < beyond
        count += past[c]
    return count


@inlined
def risen_by(c, i, time, normal, point, center, angular):
    """Return how far (m) the turning of body i takes contact c along its normal within a time (s)."""
    if i < 0:
        return 0.0
    wx, wy, wz = angular[i, 0], angular[i, 1], angular[i, 2]
    speed = sqrt(wx * wx + wy * wy + wz * wz)
    if speed == 0.0:
        return 0.0
    ux, uy, uz = wx / speed, wy / speed, wz / speed
    x, y, z = point[c, 0] - center[i, 0], point[c, 1] - center[i, 1], point[c, 2] - center[i, 2]
    ax, ay, az = cross(ux, uy, uz, x, y, z)  # across, and from there to the axis
    tx, ty, tz = cross(ux, uy, uz, ax, ay, az)
    nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
    across, inward = nx * ax + ny * ay + nz * az, nx * tx + ny * ty + nz * tz
    return sin(speed * time) * across + (1.0 - cos(speed * time)) * inward
