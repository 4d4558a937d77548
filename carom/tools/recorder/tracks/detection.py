"""Detection: how pairs were measured, and which limits of the step cut something short."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import ClassVar

from carom.ecs import World
from carom.systems.detection.answered import Answered
from carom.systems.simulation import Simulation
from carom.tools.recorder.curves import Curves
from carom.tools.recorder.layout import Layout


class Detection(Curves):
    """Counts since the recorded frame before: pairs by FCL, by kernels and recycled, detections, what was cut."""

    key: ClassVar[str] = "detection"
    detail: ClassVar[str] = "solver"
    title: ClassVar[str] = "Pairs measured"

    def __init__(self) -> None:
        super().__init__()
        self._before: Counter[str] | None = None

    def lay_out(self, world: World, layout: Layout) -> None:
        """Leave it to be asked for."""

    def read(self, simulation: Simulation) -> Mapping[str, float]:
        """Return by how much each count has grown."""
        now = Counter(vars(simulation.world[Answered]))
        before, self._before = now if self._before is None else self._before, now
        return {name: float(count - before[name]) for name, count in now.items()}
