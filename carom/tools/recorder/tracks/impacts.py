"""Impacts: who struck whom, where and how hard, of every step."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from carom.ecs.relations.impact import Impact
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Columns, joined
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track

PATH = "impacts"
NUMBERS = ("time", "a", "b", "speed", "impulse", "work")
VECTORS = ("point", "normal")


class Impacts(Track):
    """The impact table of every step in which there were any; vectors are float32."""

    key: ClassVar[str] = "impacts"
    every_step: ClassVar[bool] = True

    def __init__(self) -> None:
        self._pending: list[tuple[Stamp, Columns]] = []

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the impacts of the last step."""
        impact = simulation.world[Impact]
        if impact.count:
            rows = {name: getattr(impact, name)[: impact.count].copy() for name in NUMBERS}
            rows |= {name: getattr(impact, name)[: impact.count].astype(np.float32) for name in VECTORS}
            self._pending.append((stamp, rows))

    def write(self, stream: Stream) -> None:
        """Write the kept impacts."""
        if self._pending:
            block = joined(self._pending)
            stream.rows(PATH, block.stamps, block.values(block.columns))
            self._pending = []
