"""Round numbers: 1, 2 and 5 times powers of ten, for scales that people read."""

from __future__ import annotations

import math

SLACK = 1e-9  # by which a value may miss a round number for rounding


def last_round(value: float) -> float:
    """Return the largest round number that is not above ``value``, which is above 0."""
    power = 10.0 ** math.floor(math.log10(value))
    return max(factor * power for factor in (1.0, 2.0, 5.0) if factor * power <= value * (1.0 + SLACK))


def next_round(value: float) -> float:
    """Return the smallest round number that is not below ``value``, which is above 0."""
    power = 10.0 ** math.floor(math.log10(value))
    return min(factor * power for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= value * (1.0 - SLACK))
