"""Last seconds: a run is kept in a ring, and what led there is shown once something goes wrong."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from carom.systems.observer import Observer
from carom.systems.ring import Ring
from carom.systems.simulation import Simulation
from carom.worlds.expectation import Expectation


class LastSeconds:
    """Show an observer, such as a recorder, what a ring has kept when the first expectation fails, or by `show`.

    That happens once; ``shown`` tells whether it has.
    """

    def __init__(self, ring: Ring, observer: Observer, expectations: Sequence[Expectation] = ()) -> None:
        self.shown = False
        self._ring, self._observer, self._expectations = ring, observer, expectations

    def begin(self, simulation: Simulation) -> None:
        """Keep the world before its first step."""
        self._ring.begin(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Keep the world; show what led here if an expectation has failed."""
        if not self.shown:
            self._ring.observe(simulation)
            if not all(expectation.held for expectation in self._expectations):
                self.show(simulation)

    def end(self, simulation: Simulation) -> None:
        """Wait to be asked."""

    def show(self, simulation: Simulation) -> None:
        """Show what led here, unless that has been done."""
        if not self.shown:
            self.shown = True
            with np.errstate(all="ignore"):  # as in the run: the step itself finds what is not finite
                self._ring.show(simulation, self._observer)
