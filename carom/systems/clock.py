"""The clock: real time in frames of any length, handed out as whole steps."""

from __future__ import annotations

import math

from carom.ecs.errors import DeclarationError
from carom.systems.constants import EARLY

# Time is counted in whole ticks of 2**-64 s. Every float from 0.3 ms up is a whole number of them, so that sums are
# exact: however a stretch of time is cut into frames, the same steps come due.
TICKS = 2**64

# s. One frame never asks for more: beyond it a machine too slow for its world would fall behind ever further, since
# every late frame asks for more steps than the one before. In time, not in steps, so that a short dt drops no more.
CATCH_UP = 0.25


class Clock:
    """Real time that is owed to a simulation, and what was dropped of it because a frame took too long."""

    def __init__(self) -> None:
        self.catch_up = CATCH_UP
        self._owed = 0
        self._dropped = 0

    @property
    def owed(self) -> float:
        """Seconds that have passed since the last step came due."""
        return self._owed / TICKS

    @property
    def dropped(self) -> float:
        """Seconds that were never simulated; always a whole number of steps."""
        return self._dropped / TICKS

    def steps(self, seconds: float, dt: float) -> int:
        """Let ``seconds`` pass; return how many steps of ``dt`` are to be taken: those due, up to `catch_up`, or one.

        Raises DeclarationError for time that runs backwards or is no number.
        """
        if not (math.isfinite(seconds) and seconds >= 0.0):
            raise DeclarationError(f"real time must be finite and at least 0 s, received {seconds:g} s")
        step = int(dt * TICKS)
        self._owed += int(seconds * TICKS)
        due = (self._owed + step // EARLY) // step
        taken = int(min(due, max(self.catch_up / dt * (1.0 + 1.0 / EARLY), 1.0)))
        self._owed -= due * step
        self._dropped += (due - taken) * step
        return taken

    def part(self, dt: float) -> float:
        """Return how far time is into the next step, from 0 to below 1."""
        return max(self._owed, 0) / int(dt * TICKS)
