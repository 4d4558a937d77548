"""Reach: for how long what detection foresaw holds for the bodies as they move now."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import kernel, woven


@woven
def time_within_reach(i, span, center, detected_center, reach, linear, acceleration):
    """Return for how long (s, at most ``span``) body i cannot leave its reach.

    It may fly anywhere at its speed and acceleration: what strikes it later is asked about then.
    """
    away, quick, push = 0.0, 0.0, 0.0
    for k in range(3):
        away += (center[i, k] - detected_center[i, k]) ** 2
        quick += linear[i, k] ** 2
        push += acceleration[i, k] ** 2
    room, speed, push = reach[i] - sqrt(away), sqrt(quick), sqrt(push)
    if (speed + 0.5 * push * span) * span <= room:
        return span
    if room <= 0.0:
        return 0.0
    return min(span, 2.0 * room / (speed + sqrt(speed * speed + 2.0 * push * room)))


@woven
def time_within_all(rows, span, center, detected_center, reach, linear, acceleration):
    """Return for how long (s, at most ``span``) no body can leave its reach."""
    least = span
    for i in rows:
        least = min(least, time_within_reach(i, span, center, detected_center, reach, linear, acceleration))
    return least


@kernel()
def may_leave_reach(rows, span, center, detected_center, reach, linear, acceleration):
    """Tell whether any body may leave its reach within ``span`` seconds."""
    return time_within_all(rows, span, center, detected_center, reach, linear, acceleration) < span
