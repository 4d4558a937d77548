"""Later: an observer that sees a simulation only from a frame on."""

from __future__ import annotations

from carom.systems.observer import Observer
from carom.systems.simulation import Simulation


class Later:
    """Begin an observer, such as a recorder, at a frame; ``begun`` tells whether a run has come to it."""

    def __init__(self, observer: Observer, frame: int) -> None:
        self.begun = False
        self._observer, self._frame = observer, frame

    def begin(self, simulation: Simulation) -> None:
        """Begin if this is the frame."""
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Let it see the world, for the first time where the frame has come."""
        if self.begun:
            self._observer.observe(simulation)
        elif simulation.frame >= self._frame:
            self.begun = True
            self._observer.begin(simulation)

    def end(self, simulation: Simulation) -> None:
        """End it, if it has begun."""
        if self.begun:
            self._observer.end(simulation)
