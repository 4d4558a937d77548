"""Changes: which rows of a component hold something else than they did at a mark."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Booleans, Integers
from carom.ecs.table import Table

NOBODY = -1


class Watch:
    """What a table held when it was last looked at, and for each row the mark after which it last changed.

    Rows are compared bit by bit, so that writing the value that is there already is no change. Only watched tables pay.
    """

    def __init__(self, table: Table, handles: Integers) -> None:
        self.table = table
        self.changed_after: Integers = np.zeros(0, np.int64)
        self.held_by: Integers = np.zeros(0, np.int64)
        self.seen: dict[str, npt.NDArray[Any]] = {}
        self.look(handles, 0)

    def look(self, handles: Integers, mark: int) -> None:
        """Find what changed since the last look; it changed after ``mark``."""
        used = len(handles)
        holders = np.where(self.table.present[:used], handles, NOBODY)
        known = min(used, len(self.held_by))
        changed: Booleans = np.ones(used, np.bool_)
        changed[:known] = holders[:known] != self.held_by[:known]
        for name, array in self.table.arrays.items():
            differs = bits(array[:known]) != bits(self.seen.get(name, array)[:known])
            changed[:known] |= differs.reshape(known, -1).any(axis=1)
        after = np.full(used, mark)
        after[:known] = np.where(changed[:known], mark, self.changed_after[:known])
        self.changed_after, self.held_by = after, holders
        self.seen = {name: array[:used].copy() for name, array in self.table.arrays.items()}

    def gather(self, rows: Integers) -> None:
        """Follow `World.compact`: to be moved is no change."""
        rows = rows[rows < len(self.held_by)]
        self.changed_after, self.held_by = self.changed_after[rows], self.held_by[rows]
        self.seen = {name: array[rows] for name, array in self.seen.items()}


def bits(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return an array as whole numbers of the same bits: -0 differs from 0, and NaN equals itself."""
    return array.view(f"u{array.itemsize}") if array.dtype.kind == "f" else array
