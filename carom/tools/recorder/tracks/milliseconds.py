"""Milliseconds: how long each system of the step took."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from carom.ecs.timings import Timing, Timings
from carom.systems.simulation import Simulation
from carom.tools.recorder.curves import Curves


class Milliseconds(Curves):
    """Real time (ms) of every system that ran in the last step, called by its name; not the same in two runs."""

    key: ClassVar[str] = "milliseconds"
    detail: ClassVar[str] = "full"
    unit: ClassVar[str] = "ms"
    title: ClassVar[str] = "Systems of a step (ms)"

    def read(self, simulation: Simulation) -> Mapping[str, float]:
        """Return what the last step took; nothing before the first."""
        timings: Mapping[str, Timing] = simulation.world[Timings] if Timings in simulation.world.resources else {}
        return {
            "".join(filter(_plain, name)): 1e3 * timing.last_seconds
            for name, timing in timings.items()
            if timing.last_calls
        }


def _plain(letter: str) -> bool:
    """Tell whether a letter of a name needs no mark in the path of a curve: those of ``<lambda>`` do."""
    return letter.isalnum() or letter in "_-."
