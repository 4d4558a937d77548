"""Tables: the arrays behind one component or relation, with a writable and a read-only face."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Booleans, Integers
from carom.ecs.component import Record, Relation
from carom.ecs.slots import Rows


def by_row(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return an array as one of opaque rows, which NumPy moves about 3 times faster than rows of several numbers."""
    width = math.prod(array.shape[1:])
    if array.ndim == 1 or not width:
        return array
    opaque = np.dtype((np.void, array.itemsize * width))
    return array.reshape(len(array), width).view(opaque).reshape(len(array))


def anything(array: npt.NDArray[Any], rows: Integers) -> bool:
    """Tell whether any of ``rows`` holds anything but zeros; read in parts that fit into the processor's cache."""
    parts = range(0, len(rows), 4096)
    return any(array.take(rows[first : first + 4096]).view(np.uint8).any() for first in parts)


class Table:
    """Structure of arrays for one kind: ``arrays[name]`` has shape (capacity, *column shape), C-contiguous.

    ``live`` is the instance systems write to, ``view`` the same memory read-only. A component's table marks its rows in
    ``present``, and rows that are not present hold zeros; a relation's rows are the first ``count``.
    """

    def __init__(self, kind: type[Record], capacity: int) -> None:
        self.kind = kind
        self.capacity = 0
        self.arrays: dict[str, npt.NDArray[Any]] = {}
        self.present: Booleans = np.zeros(0, np.bool_)
        self.live = kind.blank()
        self.view = kind.blank()
        self.counted = tuple(face for face in (self.live, self.view) if isinstance(face, Relation))
        self.grow(capacity, 0)

    def grow(self, capacity: int, used: int) -> None:
        """Enlarge every array to ``capacity`` rows, keeping the first ``used``."""
        for name, column in self.kind.columns.items():
            array = column.allocate(capacity)
            if used:
                array[:used] = self.arrays[name][:used]
            self.arrays[name] = array
            face = array.view()
            face.flags.writeable = False
            setattr(self.live, name, array)
            setattr(self.view, name, face)
        if not issubclass(self.kind, Relation):
            present = np.zeros(capacity, np.bool_)
            present[:used] = self.present[:used]
            self.present = present
        self.capacity = capacity

    def resize(self, count: int) -> None:
        """Set a relation's row count, growing where needed; rows beyond the old count hold what they last held."""
        if count > self.capacity:
            self.grow(max(count, 2 * self.capacity), self.capacity)
        for face in self.counted:
            face.count = count

    def fill(self, rows: Rows, bundle: Record | None) -> None:
        """Mark ``rows`` present and write the bundle's values, or each column's default where it has none."""
        fresh = not self.present[rows].any()  # then the rows hold zeros already
        self.present[rows] = True
        for name, column in self.kind.columns.items():
            value = getattr(bundle, name, None)
            if value is not None:
                self.arrays[name][rows] = value
            elif not (fresh and column.zero):
                self.arrays[name][rows] = column.default

    def clear(self, rows: Integers) -> None:
        """Unmark ``rows`` and zero them, so that nothing of a removed component lingers."""
        self.present[rows] = False
        for name, column in self.kind.columns.items():
            array = by_row(self.arrays[name])
            if column.zero and not anything(array, rows):
                continue  # what was never written takes no memory, and zeros would
            array[rows] = np.zeros((), array.dtype)

    def restore(self, rows: Rows, values: dict[str, npt.NDArray[Any]]) -> None:
        """Make exactly ``rows`` present, with these values; columns not given take their default."""
        if issubclass(self.kind, Relation):
            assert isinstance(rows, slice)
            self.resize(rows.stop)
        else:
            gone = self.present.copy()
            gone[rows] = False
            if gone.any():
                self.clear(np.nonzero(gone)[0])
            self.present[rows] = True
        for name, column in self.kind.columns.items():
            if name in values:
                by_row(self.arrays[name])[rows] = by_row(np.ascontiguousarray(values[name]))
            else:
                self.arrays[name][rows] = column.default

    def read(self, name: str, rows: Rows) -> npt.NDArray[Any]:
        """Return these rows of a column: a view of a slice, a copy of others."""
        array = self.arrays[name]
        return array[rows] if isinstance(rows, slice) else array.take(rows, axis=0)

    def gather(self, rows: Integers, used: int) -> None:
        """Move ``rows`` (sorted) to the front in their order and zero the other rows below ``used``."""
        if len(rows) == used:
            return
        for array in (*self.arrays.values(), self.present):
            array[: len(rows)] = array.take(rows, axis=0)
            array[len(rows) : used] = np.zeros((), array.dtype)

    def renumber(self, new_rows: Integers) -> None:
        """Replace the row numbers that columns hold by ``new_rows[number]``; -1 stands for none."""
        mine = slice(0, self.live.count) if isinstance(self.live, Relation) else np.nonzero(self.present)[0]
        for name, column in self.kind.columns.items():
            if column.holds == "rows":
                held = self.arrays[name][mine]
                valid = (held >= 0) & (held < len(new_rows))
                held[valid] = new_rows[held[valid]]
                self.arrays[name][mine] = held
