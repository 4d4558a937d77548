"""Changes: which rows of a component hold something else than they did at a mark."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Booleans, Integers
from carom.ecs.entity import INDEX_MASK
from carom.ecs.table import Table


class Watch:
    """What each holder of a component held when it was last looked at, and the mark after which that last changed.

    Values are compared bit by bit and by entity, so that writing the value that is there already is no change, nor is
    to be moved to another row. Only watched tables pay.
    """

    def __init__(self, table: Table, handles: Integers, first: int) -> None:
        self.table = table
        self.first = first  # the mark from which on changes are known
        self.changed_after: Integers = np.zeros(0, np.int64)  # by row; the others are by holder, in order of rows
        self.rows: Integers = np.zeros(0, np.int64)
        self.holders: Integers = np.zeros(0, np.int64)
        self.seen: dict[str, npt.NDArray[Any]] = {name: array[:0] for name, array in table.arrays.items()}
        self.look(handles, first - 1)

    def look(self, handles: Integers, mark: int) -> None:
        """Find what changed since the last look; it changed after ``mark``."""
        rows = np.nonzero(self.table.present[: len(handles)])[0]
        holders = handles[rows]
        before, known = self._places(holders)
        seen = {name: array[rows] for name, array in self.table.arrays.items()}
        same = np.ones(len(before), np.bool_)
        for name, array in seen.items():
            agrees = bits(array[known]) == bits(self.seen[name][before])
            same &= agrees.all(axis=tuple(range(1, agrees.ndim)))
        after = np.full(len(rows), mark)
        after[known] = np.where(same, self.changed_after[self.rows[before]], mark)
        self.changed_after = np.zeros(len(handles), np.int64)
        self.changed_after[rows] = after
        self.rows, self.holders, self.seen = rows, holders, seen

    def _places(self, holders: Integers) -> tuple[Integers, Booleans]:
        """Return where those of ``holders`` that were there before stood among the holders, and a mask of them."""
        ids, were = holders & INDEX_MASK, self.holders & INDEX_MASK
        place = np.full(max(ids.max(initial=-1), were.max(initial=-1)) + 1, -1)
        place[were] = np.arange(len(were))
        before = place[ids]
        known: Booleans = before >= 0
        known[known] = self.holders[before[known]] == holders[known]
        return before[known], known


def bits(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return an array as whole numbers of the same bits: -0 differs from 0, and NaN equals itself."""
    return array.view(f"u{array.itemsize}") if array.dtype.kind == "f" else array
