"""Deaths of particles: whose time is over."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import kernel


@kernel()
def any_due(dies, first, count, time):
    """Tell whether the time of any of ``count`` rows from ``first`` on is over."""
    due = 0  # counted to the end, which is sooner done than to stop in the middle
    for i in range(first, first + count):
        due += dies[i] <= time
    return due > 0
