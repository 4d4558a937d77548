"""Errors: how far bodies are from where the oracle says, and futures from the first."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from carom.ecs import World
from carom.systems.simulation import Simulation
from carom.tools.ghosts import Ghost, Ghosts
from carom.tools.recorder.curves import ROOT, Curves
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.stream import Stream, own_path
from carom.tools.recorder.track import Track
from carom.worlds.oracle import Oracle, errors


class NamedCurves(Curves):
    """Curves that bear names of the file, which may have any letters."""

    def path(self, name: str) -> str:
        """Return the path of a curve, with marks before letters that mean something in paths."""
        return own_path(f"{ROOT}/{self.key}", name)


class Errors(NamedCurves):
    """How far each entity with a closed form is from it, in m."""

    key: ClassVar[str] = "error"
    title: ClassVar[str] = "Error against the oracle (m)"
    unit: ClassVar[str] = "m"

    def silent(self, simulation: Simulation) -> bool:
        """Tell whether there is no oracle."""
        return Oracle not in simulation.world

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the plot where there is an oracle."""
        if Oracle in world:
            super().lay_out(world, layout)

    def read(self, simulation: Simulation) -> Mapping[str, float]:
        """Return a number for each entity."""
        world = simulation.world
        rows = world[Oracle].rows(world)
        values = errors(world, rows).tolist() if len(rows) else []
        return dict(zip(world.names_told(world.entities(rows)), values, strict=True))


class Differences(NamedCurves):
    """How far the farthest body of each future is from where it is in the first, in m."""

    key: ClassVar[str] = "difference"
    title: ClassVar[str] = "Difference of futures (m)"
    unit: ClassVar[str] = "m"

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write the colours of the curves, which are those of the futures."""
        import rerun

        for ghost in simulation.world[Ghosts].ghosts[1:] if Ghosts in simulation.world else []:
            color = np.rint(255.0 * np.array(ghost.color)).astype(np.uint8)
            stream.static(self.path(ghost.name), rerun.SeriesLines(colors=[color]))

    def silent(self, simulation: Simulation) -> bool:
        """Tell whether there is but this one."""
        return Ghosts not in simulation.world

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the plot where there are futures."""
        if Ghosts in world:
            super().lay_out(world, layout)

    def read(self, simulation: Simulation) -> Mapping[str, float]:
        """Return a number for each future but the first."""
        ghosts = simulation.world[Ghosts].ghosts
        return dict(_apart(ghosts[0], other) for other in ghosts[1:])


def _apart(first: Ghost, other: Ghost) -> tuple[str, float]:
    away = np.linalg.norm(other.path(-1) - first.path(-1), axis=2)
    return other.name, float(np.nanmax(away)) if np.isfinite(away).any() else np.nan
