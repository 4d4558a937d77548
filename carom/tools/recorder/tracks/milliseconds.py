"""Milliseconds: how long each system of the step took."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from statistics import median
from typing import ClassVar

from carom.ecs import World
from carom.ecs.timings import Timing, Timings
from carom.systems.simulation import Simulation
from carom.tools.recorder.curves import ROOT, Curves
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.stream import Stream

PATH = f"{ROOT}/milliseconds"
OTHERS = "others"  # below the plot
MOST = 8  # curves, whose legend leaves room for them
ENOUGH = 10  # frames


class Milliseconds(Curves):
    """Real time (ms) of every system that ran in the last step, called by its name; not the same in two runs.

    The plot shows the dearest of the first frames; all others are below it, for whoever adds them to the view.
    """

    key: ClassVar[str] = "milliseconds"
    detail: ClassVar[str] = "full"
    unit: ClassVar[str] = "ms"
    title: ClassVar[str] = "Systems of a step (ms)"

    def __init__(self) -> None:
        super().__init__()
        self._dearest: set[str] = set()
        self._ends = False

    def path(self, name: str) -> str:
        """Return the path of a system's curve: beside the others that are seen, or among those that are not."""
        return f"{PATH}/{name}" if name in self._dearest else f"{PATH}/{OTHERS}/{name}"

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the dearest."""
        layout.plot(PATH, self.title, hidden=OTHERS)

    def end(self, simulation: Simulation) -> None:
        """Write what there is, however little."""
        self._ends = True

    def write(self, stream: Stream) -> None:
        """Write the kept numbers, once there are enough to tell who is dear: the first step loads kernels."""
        if not self._dearest and (self._ends or len(self._pending) > ENOUGH):
            spent: defaultdict[str, list[float]] = defaultdict(list)
            for _, values in self._pending:
                for name, value in values.items():
                    spent[name].append(value)
            self._dearest = set(sorted(spent, key=lambda name: median(spent[name]))[-MOST:])
        if self._dearest:
            super().write(stream)

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
