"""Fast: who was looked after on their way, since they were fast for their size, and when they struck."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from carom.ecs import System
from carom.ecs.column import Column, Integers
from carom.ecs.relations.impact import Impact
from carom.systems.continuous import Fast
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Columns
from carom.tools.recorder.rows import RowTrack, handle, number
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track

FINDERS = ("find_contacts", "look_ahead", "drift")  # systems that detect


class FastPairs(RowTrack):
    """A row for each pair of colliders that was looked after in a step, with its first impact there."""

    key: ClassVar[str] = "fast"
    detail: ClassVar[str] = "solver"
    every_step: ClassVar[bool] = True
    path: ClassVar[str] = "fast"
    columns: ClassVar[Mapping[str, Column]] = {
        "a": handle("first collider"),
        "b": handle("second collider"),
        "struck": number("s", "simulated time of their first impact in the step, NaN for none"),
        "speed": number("m/s", "closing speed of that impact, NaN for none"),
    }

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Hear what is detected from now on."""
        self._simulation, self._pairs = simulation, [np.zeros((0, 2), np.int64)]
        simulation.hearers.append(self._note)

    def end(self, simulation: Simulation) -> None:
        """Hear no longer."""
        simulation.hearers.remove(self._note)

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return the pairs of the last step."""
        pairs: Integers = np.unique(np.concatenate(self._pairs), axis=0)
        if not len(pairs):
            return None
        impact, struck, speed = simulation.world[Impact], np.full(len(pairs), np.nan), np.full(len(pairs), np.nan)
        first = {frozenset((impact.a[row], impact.b[row])): row for row in reversed(range(impact.count))}
        for place, pair in enumerate(pairs):
            if (row := first.get(frozenset(pair))) is not None:
                struck[place], speed[place] = impact.time[row], impact.speed[row]
        return {"a": pairs[:, 0], "b": pairs[:, 1], "struck": struck, "speed": speed}

    def _note(self, system: System) -> None:
        world = self._simulation.world
        if system.name == "begin_step":
            self._pairs = [np.zeros((0, 2), np.int64)]
        elif system.name in FINDERS:
            rows = world[Fast].pairs
            self._pairs.append(np.sort(world.entities(rows.ravel()).reshape(-1, 2), axis=1))
