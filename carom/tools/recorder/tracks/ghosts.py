"""Ghosts: where the oracle says that bodies are, and what other futures make of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from carom.ecs import Transform, World
from carom.ecs.column import Floats, Integers
from carom.systems.settings import Settings
from carom.systems.simulation import Simulation
from carom.tools.ghosts import Ghost, ghosts_of
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.stream import Stamp, Stream, own_path
from carom.tools.recorder.track import Track
from carom.tools.recorder.tracks.bodies import Bodies

ROOT, PATHS = "world/ghosts", "world/paths"
RADIUS = -0.8  # px
ALWAYS = 1e6  # s, for which paths stay in view


class GhostBodies(Bodies):
    """The copies of one ghost, below its name."""

    def __init__(self, ghost: Ghost) -> None:
        super().__init__(own_path(ROOT, ghost.name), whose="ghost_of")
        self._ghost = ghost

    def poses(self, simulation: Simulation) -> Transform:
        """Return where the copies are."""
        return self._ghost.poses(simulation.world, simulation.world[Transform], simulation.time)

    def seen(self, world: World) -> Integers:
        """Return those who are drawn and have a copy."""
        return np.intersect1d(super().seen(world), self._ghost.rows(world))

    def colors(self, world: World, rows: Integers) -> Floats:
        """Return the colours of copies."""
        return self._ghost.tinted(super().colors(world, rows))


class GhostPath:
    """The way the bodies of one ghost have gone, from frame to frame."""

    def __init__(self, ghost: Ghost) -> None:
        self._ghost, self._path = ghost, own_path(PATHS, ghost.name)
        self._last = 0
        self._pending: list[tuple[Stamp, npt.NDArray[np.float32]]] = []

    def sample(self, stamp: Stamp) -> None:
        """Keep the ways since the last frame."""
        path = self._ghost.path(self._last)
        if len(path) > 1:
            ways = np.swapaxes(path, 0, 1).astype(np.float32)
            self._pending.append((stamp, ways[np.isfinite(ways).all(axis=(1, 2))]))
            self._last += len(path) - 1

    def write(self, stream: Stream) -> None:
        """Write the kept ways."""
        import rerun

        for stamp, ways in self._pending:
            color = np.rint(255.0 * np.array(self._ghost.color)).astype(np.uint8)
            stream.row(self._path, stamp, rerun.LineStrips3D(ways, colors=[color], radii=[RADIUS]))
        self._pending = []


class GhostTrack(Track):
    """Every ghost of the world and its path, each below its own name."""

    key: ClassVar[str] = "ghosts"

    def __init__(self) -> None:
        self._bodies: list[GhostBodies] = []
        self._paths: list[GhostPath] = []

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Take the ghosts that there are."""
        ghosts = ghosts_of(simulation.world)
        self._bodies = [GhostBodies(ghost) for ghost in ghosts]
        self._paths = [GhostPath(ghost) for ghost in ghosts if ghost.color is not None]
        for bodies in self._bodies:
            bodies.only = self.only

    def silent(self, simulation: Simulation) -> bool:
        """Tell whether there are none."""
        return not ghosts_of(simulation.world)

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show whole paths."""
        for ghost in ghosts_of(world):
            if ghost.color is not None:
                layout.keep(own_path(PATHS, ghost.name), ALWAYS, world[Settings].dt)

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep where the copies are."""
        for bodies in self._bodies:
            bodies.sample(simulation, stamp, stream)
        for path in self._paths:
            path.sample(stamp)

    def write(self, stream: Stream) -> None:
        """Write copies and paths."""
        for bodies in self._bodies:
            bodies.write(stream)
        for path in self._paths:
            path.write(stream)
