"""Pace: simulated time held to the clock on the wall."""

from __future__ import annotations

import time

from carom.systems.simulation import Simulation


class Pace:
    """The observer that holds a run to ``speed`` simulated seconds a second; where it cannot keep up, it does not wait.

    What was lost is caught up with.
    """

    def __init__(self, speed: float) -> None:
        self._speed = speed
        self._start = self._began = 0.0

    def begin(self, simulation: Simulation) -> None:
        """Look at both clocks."""
        self._start, self._began = simulation.time, time.monotonic()

    def observe(self, simulation: Simulation) -> None:
        """Wait until the step is due."""
        due = self._began + (simulation.time - self._start) / self._speed
        time.sleep(max(0.0, due - time.monotonic()))

    def end(self, simulation: Simulation) -> None:
        """Have nothing to finish."""
