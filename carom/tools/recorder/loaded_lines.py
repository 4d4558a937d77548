"""Loaded lines: a table whose rows are lines from body to body, coloured by what they bear."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from carom.ecs import Transform
from carom.ecs.column import Floats
from carom.ecs.components.joint import Joint
from carom.ecs.components.spring import Spring
from carom.systems.simulation import Simulation
from carom.tools.coloring import on_scale
from carom.tools.jointed import Jointed, jointed
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.rows import RowTrack
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track
from carom.tools.round_numbers import next_round

RADIUS = -1.5  # px
PALER = 0.35  # of white, so that what bears nothing is seen on the dark background


class LoadedLines(RowTrack):
    """All of a kind whose ends are there; the scale of colours ends at the largest load so far."""

    detail: ClassVar[str] = "full"
    sparse: ClassVar[bool] = True
    kind: ClassVar[type[Joint] | type[Spring]]
    told: ClassVar[tuple[str, ...]]

    def __init__(self) -> None:
        super().__init__()
        self._most = 0.0

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write how wide the lines are."""
        import rerun

        stream.static(self.path, rerun.LineStrips3D.from_fields(radii=[RADIUS]))

    @abstractmethod
    def lines(self, found: Jointed) -> Floats:
        """Return the points of the lines (n, k, 3)."""

    @abstractmethod
    def loads(self, columns: Columns) -> Floats:
        """Return what each bears (n,), N."""

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return a row for each; nothing of a world without any."""
        world = simulation.world
        found = jointed(world, self.kind, world[Transform])
        if not len(found.rows):
            return None
        told: Columns = {name: getattr(world[self.kind], name)[found.rows] for name in self.told}
        names = np.array(world.names_told(world.entities(found.rows)), np.str_)
        return {"name": names} | told | {"line": self.lines(found).astype(np.float32)}

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Return the lines."""
        import rerun

        loads = self.loads(block.columns)
        self._most = max(self._most, float(loads.max(initial=0.0)))
        shares = loads / next_round(self._most) if self._most > 0.0 else loads
        colors = PALER + (1.0 - PALER) * on_scale(shares)
        return block.drawn(rerun.LineStrips3D.from_fields(strips=block.columns["line"], colors=colors))
