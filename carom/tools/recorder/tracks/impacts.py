"""Impacts: who struck whom, where and how hard, of every step."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from carom.ecs.column import Column
from carom.ecs.relations.impact import Impact
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Columns
from carom.tools.recorder.rows import RowTrack


class Impacts(RowTrack):
    """The impact table of every step in which there were any; vectors are float32."""

    key: ClassVar[str] = "impacts"
    every_step: ClassVar[bool] = True
    path: ClassVar[str] = "impacts"
    columns: ClassVar[Mapping[str, Column]] = {
        name: Impact.columns[name] for name in ("time", "a", "b", "speed", "impulse", "work", "point", "normal")
    }

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return the impacts of the last step."""
        impact = simulation.world[Impact]
        if not impact.count:
            return None
        held = {name: getattr(impact, name)[: impact.count] for name in self.columns}
        return {name: values.astype(np.float32 if values.ndim == 2 else values.dtype) for name, values in held.items()}
