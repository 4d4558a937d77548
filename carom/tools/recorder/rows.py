"""Rows: a track that is a table, of which each frame has some rows."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from carom.ecs import World
from carom.ecs.column import Column
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Block, Columns, Pending
from carom.tools.recorder.choice import Choice
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track


class RowTrack(Track):
    """Rows of declared columns, written below ``path``; `carom query` has them as a table called by the track's key.

    A column is written under its own name, but for those ``drawn``, of which Rerun's own component by that name holds
    the values: ``{"point": "Points3D:positions"}``, float32. One that is ``sparse`` has no table where it has no rows.
    """

    path: ClassVar[str]
    columns: ClassVar[Mapping[str, Column]]
    drawn: ClassVar[Mapping[str, str]] = {}
    sparse: ClassVar[bool] = False

    def __init__(self) -> None:
        self._pending = Pending()

    @abstractmethod
    def rows(self, simulation: Simulation) -> Columns | None:
        """Return the rows of this frame as columns of their own; None for a frame that says nothing."""

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Return what is drawn of the rows at their path, the columns ``drawn`` among it; write what is elsewhere."""
        return ()

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the rows of this frame."""
        rows = self.rows(simulation)
        if rows is not None and self.only is not None:
            rows = self._chosen(simulation.world, rows, self.only)
        if rows is not None:
            self.keep(stamp, rows)

    def _chosen(self, world: World, rows: Columns, only: Choice) -> Columns:
        """Return the rows of which any entity is chosen; all of a table without entities."""
        handles = [rows[name] for name, column in self.columns.items() if column.holds == "entities"]
        if not handles:
            return rows
        kept = np.logical_or.reduce([only.has(world, column) for column in handles])
        return {name: values[kept] for name, values in rows.items()}

    def keep(self, stamp: Stamp, rows: Columns) -> None:
        """Keep rows, by the names of their columns."""
        self._pending.put(stamp, rows)
        self.kept = self._pending.size

    def write(self, stream: Stream) -> None:
        """Write the kept rows as one block."""
        if self._pending.stamps:
            block = self._pending.take()
            values = block.values(name for name in self.columns if name not in self.drawn)
            stream.rows(self.path, block.stamps, [*self.draw(block, stream), *values])
            self.kept = 0


def number(unit: str, doc: str, *shape: int, dtype: str = "float64") -> Column:
    """Return a column of numbers that no component declares."""
    return Column(shape, np.dtype(dtype), 0, unit, doc, "derived", "values")


def handle(doc: str) -> Column:
    """Return a column of entities."""
    return Column((), np.dtype(np.int64), -1, "1", doc, "derived", "entities")


def text(doc: str) -> Column:
    """Return a column of words."""
    return Column((), np.dtype(np.str_), "", "1", doc, "derived", "values")
