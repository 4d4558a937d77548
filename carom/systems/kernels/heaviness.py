"""Heaviness: which impacts may drive bodies that rest into each other, and how far they may."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BLOW_SINK, TOUCH
from carom.systems.kernels.balls import BALL, NEVER
from carom.systems.kernels.bodies import surface_velocity
from carom.systems.kernels.kernel import woven


@woven
def sink_allowed(p, body_a, body_b, inertia, inverse_mass):
    """Return how far (m) a blow may sink the bodies of a pair that rests into each other."""
    size = NEVER
    for i in (body_a[p], body_b[p]):
        if i >= 0 and inverse_mass[i] > 0.0:
            size = min(size, min(inertia[i, 0], inertia[i, 1], inertia[i, 2]) * inverse_mass[i])
    return max(TOUCH, BLOW_SINK * sqrt(size))


@woven
def least_gap(p, end, start, kind, ball, other, center, other_position, radius, extent, depth):
    """Return what the gap of a pair is (m), or 0 where that is not known; its contacts are rows p to ``end``."""
    if kind[p] == BALL:
        i, o, squared = ball[p], other[p], 0.0
        for k in range(3):
            squared += (center[i, k] - (center[o, k] if o >= 0 else other_position[p, k])) ** 2
        return sqrt(squared) - radius[p] - extent[p, 0]
    if kind[p] >= 0 or start > 0.0:  # depths are those of the start
        return 0.0
    deepest = depth[p]
    for c in range(p + 1, end):
        deepest = max(deepest, depth[c])
    return -deepest


@woven
def is_heavy(
    p, gap, body_a, body_b, span, kind, ball, other, center, normal, offset_a, offset_b, linear, angular, inertia,
    inverse_mass,
):  # fmt: skip
    """Tell whether the bodies of a pair meet so fast within ``span`` seconds that they may drive others together."""
    if kind[p] == BALL and other[p] >= 0:
        speed = closing_of_balls(ball[p], other[p], center, linear)
    else:
        speed = 0.0
        for i, offset, sense in ((body_a[p], offset_a, 1.0), (body_b[p], offset_b, -1.0)):
            if i >= 0:
                x, y, z = surface_velocity(i, offset[p, 0], offset[p, 1], offset[p, 2], linear, angular)
                speed += sense * (normal[p, 0] * x + normal[p, 1] * y + normal[p, 2] * z)
    return speed * span - gap > sink_allowed(p, body_a, body_b, inertia, inverse_mass)


@woven
def closing_of_balls(i, o, center, linear):
    """Return how fast (m/s) two balls close, whose contact in the table is as it was measured at last."""
    way, speed = 0.0, 0.0
    for k in range(3):
        apart = center[o, k] - center[i, k]
        way += apart * apart
        speed += apart * (linear[i, k] - linear[o, k])
    return speed / sqrt(way) if way > 0.0 else 0.0
