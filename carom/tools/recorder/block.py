"""Block: rows of several frames, joined to be written at once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import prod
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.tools.recorder.stream import Stamp

Columns = dict[str, npt.NDArray[Any]]


class Block(NamedTuple):
    """When there were rows, how many each time, and the columns of all, numbers (n,) or vectors (n, width)."""

    stamps: list[Stamp]
    counts: list[int]
    columns: Columns

    def values(self, names: Iterable[str]) -> list[Any]:
        """Return columns as Rerun takes them, in their own precision."""
        import rerun

        columns = {name: _arrow(self.columns[name]) for name in names}
        return self.drawn(rerun.AnyValues(**columns)) if columns else []

    def drawn(self, archetype: Any) -> list[Any]:
        """Return what an archetype has of all rows as Rerun takes it; its own `columns` counts them one by one."""
        return [batch.partition(self.counts) for batch in archetype.as_component_batches()]


class Pending:
    """Rows of several times, as arrays of their own until they are joined in a block."""

    def __init__(self) -> None:
        self.stamps: list[Stamp] = []
        self.size = 0  # bytes
        self._parts: list[Columns] = []

    def put(self, stamp: Stamp, rows: Columns) -> None:
        """Keep rows, all columns of as many."""
        self.stamps.append(stamp)
        self._parts.append(rows)
        self.size += sum(values.nbytes for values in rows.values())

    def take(self) -> Block:
        """Return all rows as a block, and keep none."""
        block = joined(list(zip(self.stamps, self._parts, strict=True)))
        self.stamps, self.size, self._parts = [], 0, []
        return block


class Room(Pending):
    """Memory for the rows of a block, where kernels write those of each time, so that none is joined.

    ``kinds`` are the columns by their names: the shape of a row, and its dtype.
    """

    def __init__(self, kinds: Mapping[str, tuple[tuple[int, ...], type]]) -> None:
        super().__init__()
        self._kinds = kinds
        self._row = sum(prod(shape) * np.dtype(kind).itemsize for shape, kind in kinds.values())
        self._memory, self._room = self._new(0), 0
        self._counts: list[int] = []
        self._taken = 0

    def offer(self, count: int) -> Columns:
        """Return memory for so many rows; those that are put, from the first on, stay where they are."""
        if self._taken + count > self._room:
            before, self._room = self._memory, max(2 * self._room, self._taken + count)
            self._memory = self._new(self._room)
            for name, values in before.items():
                self._memory[name][: self._taken] = values[: self._taken]
        return {name: values[self._taken : self._taken + count] for name, values in self._memory.items()}

    def put(self, stamp: Stamp, rows: Columns) -> None:
        """Keep rows, most often of what was offered."""
        count = len(next(iter(rows.values())))
        if count and any(values.base is not self._memory[name] for name, values in rows.items()):
            for name, values in self.offer(count).items():
                values[...] = rows[name]
        self.stamps.append(stamp)
        self._counts.append(count)
        self._taken += count
        self.size = self._taken * self._row

    def take(self) -> Block:
        """Return all rows as a block, and keep none; the next has as much room."""
        columns = {name: values[: self._taken] for name, values in self._memory.items()}
        block = Block(self.stamps, self._counts, columns)
        self._room = self._taken
        self._memory = self._new(self._room)
        self.stamps, self._counts, self._taken, self.size = [], [], 0, 0
        return block

    def _new(self, count: int) -> Columns:
        return {name: np.empty((count, *shape), kind) for name, (shape, kind) in self._kinds.items()}


def joined(pending: Sequence[tuple[Stamp, Columns]]) -> Block:
    """Return the block of what was kept at one time or several."""
    stamps, parts = zip(*pending, strict=True)
    columns = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    return Block(list(stamps), [len(next(iter(part.values()))) for part in parts], columns)


def _arrow(values: npt.NDArray[Any]) -> Any:
    import pyarrow

    numbers = pyarrow.array(values.ravel())
    return numbers if values.ndim == 1 else pyarrow.FixedSizeListArray.from_arrays(numbers, prod(values.shape[1:]))
