"""Sweeps and levels: what the resting stage did within each substep."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from carom.ecs.column import Column
from carom.systems.simulation import Simulation
from carom.systems.solving import Solving
from carom.tools.recorder.block import Columns
from carom.tools.recorder.rows import RowTrack, number, text
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track
from carom.tools.recorder.tracks.solver import RESIDUAL, SUBSTEP, Solver, columns_of, count


def solving_of(tracks: Mapping[str, Track]) -> Solving:
    """Return what the track of the solver looks at."""
    solver = tracks[Solver.key]
    assert isinstance(solver, Solver)
    return solver.solving


class Sweeps(RowTrack):
    """A row for each sweep over all groups; number 0 is before the first of a stage."""

    key: ClassVar[str] = "sweeps"
    detail: ClassVar[str] = "solver"
    every_step: ClassVar[bool] = True
    path: ClassVar[str] = "solver/sweeps"
    columns: ClassVar[Mapping[str, Column]] = SUBSTEP | {
        "stage": text("solve, before bodies move, or relax, after it"),
        "number": count("sweeps of the stage so far"),
        "residual": number("m/s", RESIDUAL),
        "residual_sum": number("m/s", "sum over all points"),
    }

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Look where the track of the solver does."""
        self._solving = solving_of(tracks)

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return the sweeps of the last step."""
        return columns_of(self.columns, self._solving.sweeps)


class Levels(RowTrack):
    """A row for each level of groups that share no moving body."""

    key: ClassVar[str] = "levels"
    detail: ClassVar[str] = "solver"
    every_step: ClassVar[bool] = True
    path: ClassVar[str] = "solver/levels"
    columns: ClassVar[Mapping[str, Column]] = SUBSTEP | {
        "level": count("in order of solving"),
        "groups": count("groups of up to eight manifolds"),
        "manifolds": count("manifolds that rest"),
        "points": count("their points"),
    }

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Look where the track of the solver does."""
        self._solving = solving_of(tracks)

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return the levels of the last step."""
        return columns_of(self.columns, self._solving.levels)
