"""Solving: what the resting stage did in each substep of the last step, for those who ask."""

from __future__ import annotations

from contextlib import suppress
from typing import NamedTuple

from carom.ecs import System
from carom.ecs.column import Floats
from carom.systems.kernels import groups as of
from carom.systems.kernels import residuals as left
from carom.systems.kernels.lanes import WIDTH, aligned
from carom.systems.kernels.residuals import FOUND, find_residuals
from carom.systems.progress import Progress
from carom.systems.resting import Resting, Stage
from carom.systems.simulation import Simulation


class Sweep(NamedTuple):
    """What a sweep over all groups left: residuals of its points (m/s, `find_residuals`), and limits at work.

    ``part`` is the number of the substep in its step, from 1 on, ``time`` (s) its end; ``number`` counts sweeps of the
    stage, 0 is before the first. ``open`` points bear nothing, ``pushed`` ones part with the highest speed at which
    overlap leaves; of manifolds friction ``sliding``, ``spinning`` and ``rolling`` is all that it may be.
    """

    part: int
    time: float
    stage: str
    number: int
    residual: float
    residual_sum: float
    open: int
    pushed: int
    sliding: int
    spinning: int
    rolling: int


class Level(NamedTuple):
    """What was solved side by side, since no two of its manifolds share a moving body: a colour of the contacts."""

    part: int
    time: float
    level: int
    groups: int
    manifolds: int
    points: int


class Solving:
    """Sweeps and levels of the last step, in order of time; no bit of the simulation depends on it.

    Substeps in which nothing rests have neither; where contacts are found anew on the way, none is relaxed. Sweeps take
    several times as long while they are looked at.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation, self._resting = simulation, simulation.world[Resting]
        self.sweeps: list[Sweep] = []
        self.levels: list[Level] = []
        simulation.hearers.append(self._note)
        self._resting.hearers.append(self._look)

    def close(self) -> None:
        """Look no longer."""
        with suppress(ValueError):
            self._simulation.hearers.remove(self._note)
            self._resting.hearers.remove(self._look)

    def _note(self, system: System) -> None:
        if system.name == "begin_step":
            self.sweeps, self.levels = [], []

    def _look(self, stage: Stage, number: int) -> None:
        resting, progress = self._resting, self._simulation.world[Progress]
        if resting.groups and not resting.asks[: resting.groups].any():
            return  # contacts were found anew since they were solved: those rest from the next substep on
        when = progress.substep, progress.clock + stage.h
        if stage.name == "solve" and number == 0:
            self._look_at_levels(*when)
        found = aligned(FOUND * resting.groups, WIDTH)
        find_residuals(
            0, resting.groups, stage.h, resting.ends, stage.soft, stage.rigid, resting.index_a, resting.index_b,
            resting.points, resting.row, resting.asks, resting.lanes, resting.bodies, found,
        )  # fmt: skip
        rows: Floats = found.reshape(-1, FOUND, WIDTH)
        counts = (int(rows[:, row].sum()) for row in (left.OPEN, left.PUSHED, left.SLIDING, left.SPINNING, left.ROLLS))
        largest, summed = float(rows[:, left.LARGEST].max(initial=0.0)), float(rows[:, left.SUMMED].sum())
        self.sweeps.append(Sweep(*when, stage.name, number, largest, summed, *counts))

    def _look_at_levels(self, part: int, time: float) -> None:
        resting, begin = self._resting, 0
        for level, end in enumerate(resting.level_ends()):
            rests = resting.lanes[resting.row[begin:end] + of.RESTS] > 0.0
            points = int(resting.size[begin:end][rests].sum())
            self.levels.append(Level(part, time, level, end - begin, int(rests.sum()), points))
            begin = end
