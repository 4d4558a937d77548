"""Trails: the way each body has gone over the last seconds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Integers
from carom.systems.bodies import centers_of_mass
from carom.systems.settings import Settings
from carom.systems.simulation import Simulation
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track

PATH = "world/trails"
COLOR = (89, 204, 255, 255)
RADIUS = -0.8  # px
SECONDS = 2.0  # that the view shows of them


class Trails(Track):
    """Where centres of mass went from frame to frame; the view shows those of the last seconds together."""

    key: ClassVar[str] = "trails"
    detail: ClassVar[str] = "full"

    def __init__(self) -> None:
        self._last: tuple[Integers, npt.NDArray[np.float64]] = np.zeros(0, np.int64), np.zeros((0, 3))
        self._pending: list[tuple[Stamp, npt.NDArray[np.float32]]] = []

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write how they look."""
        import rerun

        stream.static(PATH, rerun.LineStrips3D.from_fields(colors=[COLOR], radii=[RADIUS]))

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the last seconds."""
        layout.keep(PATH, SECONDS, world[Settings].dt)

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the ways since the last frame of those who were there and moved."""
        world = simulation.world
        rows = world.row_numbers(Transform, Motion, RigidBody)
        if self.only is not None:
            rows = rows[self.only.rows(world)[rows]]
        bodies, centers = world.entities(rows), centers_of_mass(world, rows)
        _, here, there = np.intersect1d(bodies, self._last[0], assume_unique=True, return_indices=True)
        ways = np.stack([self._last[1][there], centers[here]], axis=1)
        moved = (ways[:, 0] != ways[:, 1]).any(axis=1)
        self._pending.append((stamp, ways[moved].astype(np.float32)))
        self._last = bodies, centers

    def write(self, stream: Stream) -> None:
        """Write the kept ways."""
        import rerun

        if self._pending:
            stamps, ways = zip(*self._pending, strict=True)
            columns = rerun.LineStrips3D.columns(strips=np.concatenate(ways))
            stream.rows(PATH, stamps, columns.partition([len(part) for part in ways]))
            self._pending = []
