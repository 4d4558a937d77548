"""Solver: what the resting stage did in every substep."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any, ClassVar, NamedTuple

import numpy as np

from carom.ecs.column import Column
from carom.systems.simulation import Simulation
from carom.systems.solving import Level, Solving, Sweep
from carom.tools.recorder.block import Columns
from carom.tools.recorder.rows import RowTrack, number
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track


def count(doc: str) -> Column:
    """Return a column of whole numbers."""
    return number("1", doc, dtype="int64")


SUBSTEP = {"time": number("s", "end of the substep"), "part": count("which substep of the step, from 1 on")}
RESIDUAL = "largest residual of a point, |min(parting, impulse / mass)|"


class Substep(NamedTuple):
    """A row of `Solver`."""

    time: float
    part: int
    levels: int
    groups: int
    manifolds: int
    points: int
    warm: int
    solved: float
    solved_sum: float
    relaxed: float
    relaxed_sum: float
    open: int
    pushed: int
    sliding: int
    spinning: int
    rolling: int


class Solver(RowTrack):
    """A row for each substep in which anything rests."""

    key: ClassVar[str] = "solver"
    detail: ClassVar[str] = "solver"
    every_step: ClassVar[bool] = True
    path: ClassVar[str] = "solver/substeps"
    columns: ClassVar[Mapping[str, Column]] = SUBSTEP | {
        "levels": count("levels (colours) of groups, solved one after the other"),
        "groups": count("groups of up to eight manifolds, solved side by side"),
        "manifolds": count("manifolds that rest"),
        "points": count("their points"),
        "warm": count("points that began with the impulse of the substep before"),
        "solved": number("m/s", f"{RESIDUAL}, after solving"),
        "solved_sum": number("m/s", "sum over all points, after solving"),
        "relaxed": number("m/s", f"{RESIDUAL}, after relaxing; NaN where contacts were found anew before"),
        "relaxed_sum": number("m/s", "sum over all points, after relaxing"),
        "open": count("points that bear nothing, since they do not pull"),
        "pushed": count("points whose overlap leaves with the highest speed there is"),
        "sliding": count("manifolds whose friction is all that the cone allows"),
        "spinning": count("manifolds whose friction about the normal is all it may be"),
        "rolling": count("manifolds whose rolling friction is all it may be"),
    }

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Look at the solver from now on."""
        self.solving = Solving(simulation)

    def end(self, simulation: Simulation) -> None:
        """Look no longer."""
        self.solving.close()

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return the substeps of the last step."""
        levels = {key: list(held) for key, held in groupby(self.solving.levels, lambda level: level.part)}
        sweeps = groupby(self.solving.sweeps, lambda sweep: sweep.part)
        return columns_of(self.columns, [_substep(list(held), levels.get(part, [])) for part, held in sweeps])


def _substep(sweeps: list[Sweep], levels: list[Level]) -> Substep:
    """Return a row of what was done in one substep; limits are those of the last sweep."""
    begun, last, points = sweeps[0], sweeps[-1], sum(level.points for level in levels)
    ends = {sweep.stage: (sweep.residual, sweep.residual_sum) for sweep in sweeps}
    nothing = (np.nan, np.nan)
    return Substep(
        begun.time, begun.part, len(levels), sum(level.groups for level in levels),
        sum(level.manifolds for level in levels), points, points - begun.open,
        *ends.get("solve", nothing), *ends.get("relax", nothing),
        last.open, last.pushed, last.sliding, last.spinning, last.rolling,
    )  # fmt: skip


def columns_of(columns: Mapping[str, Column], rows: Sequence[tuple[Any, ...]]) -> Columns | None:
    """Return rows with fields of these names as columns; None for no rows."""
    if not rows:
        return None
    return {name: np.array([getattr(row, name) for row in rows], column.dtype) for name, column in columns.items()}
