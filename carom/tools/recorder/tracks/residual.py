"""Residual: what the resting stage left open in the worst place of a step, as curves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from carom.systems.simulation import Simulation
from carom.tools.recorder.curves import Curves
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track
from carom.tools.recorder.tracks.sweeps import solving_of


class Residual(Curves):
    """The largest residual (m/s) in any substep of the last step, after solving and after relaxing; 0 for none."""

    key: ClassVar[str] = "residual"
    detail: ClassVar[str] = "solver"
    unit: ClassVar[str] = "m/s"
    title: ClassVar[str] = "Left open by the solver (m/s)"

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Look where the track of the solver does."""
        self._solving = solving_of(tracks)

    def read(self, simulation: Simulation) -> Mapping[str, float]:
        """Return the worst after the last sweep of each stage."""
        last = {(sweep.stage, sweep.part): sweep.residual for sweep in self._solving.sweeps}
        worst = {"solve": 0.0, "relax": 0.0}
        for (stage, _), residual in last.items():
            worst[stage] = max(worst[stage], residual)
        return worst
