"""Sleep: how many bodies are awake, might fall asleep, and sleep."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from carom.systems.simulation import Simulation
from carom.systems.sleep_state import STATES, pushed_bodies, sleep_states
from carom.tools.coloring import SLEEP
from carom.tools.recorder.curves import ROOT, Curves
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track


class Sleep(Curves):
    """The numbers of bodies in each state, of those that can be pushed."""

    key: ClassVar[str] = "sleep"
    detail: ClassVar[str] = "full"
    title: ClassVar[str] = "Bodies by state"

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write the colours of the curves, those of the states."""
        import rerun

        for state in STATES[1:]:
            color = np.rint(255.0 * np.array(SLEEP[state])).astype(np.uint8)
            stream.static(f"{ROOT}/{self.key}/{state}", rerun.SeriesLines(colors=[color], widths=[2.0]))

    def read(self, simulation: Simulation) -> Mapping[str, float]:
        """Return how many are in each state."""
        world = simulation.world
        counts = np.bincount(sleep_states(world, pushed_bodies(world)), minlength=len(STATES))
        return dict(zip(STATES[1:], counts[1:].tolist(), strict=True))
