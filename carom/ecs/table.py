"""Tables: the arrays behind one component or relation, with a writable and a read-only face."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Booleans
from carom.ecs.component import Record, Relation
from carom.ecs.errors import DeclarationError


class Table:
    """Structure of arrays for one kind: ``arrays[name]`` has shape (capacity, *column shape), C-contiguous.

    ``live`` is the instance systems write to, ``view`` the same memory read-only. A component's table marks its rows in
    ``present``; a relation's rows are the first ``count``.
    """

    def __init__(self, kind: type[Record], capacity: int) -> None:
        self.kind = kind
        self.capacity = 0
        self.arrays: dict[str, npt.NDArray[Any]] = {}
        self.present: Booleans = np.zeros(0, np.bool_)
        self.live = kind.blank()
        self.view = kind.blank()
        self.grow(capacity)

    def grow(self, capacity: int) -> None:
        """Enlarge every array to ``capacity`` rows, keeping what they hold."""
        for name, column in self.kind.columns.items():
            array = column.allocate(capacity)
            if self.capacity:
                array[: self.capacity] = self.arrays[name]
            self.arrays[name] = array
            face = array.view()
            face.flags.writeable = False
            setattr(self.live, name, array)
            setattr(self.view, name, face)
        present = np.zeros(capacity, np.bool_)
        present[: self.capacity] = self.present
        self.present, self.capacity = present, capacity

    def resize(self, count: int) -> None:
        """Set a relation's row count, growing where needed; rows beyond the old count hold what they last held."""
        if count > self.capacity:
            self.grow(max(count, 2 * self.capacity))
        for face in (self.live, self.view):
            assert isinstance(face, Relation)
            face.count = count

    def fill(self, rows: Any, bundle: Record | None) -> None:
        """Mark ``rows`` present and write the bundle's values, or each column's default where it has none."""
        self.present[rows] = True
        for name, column in self.kind.columns.items():
            value = getattr(bundle, name, None)
            target = self.arrays[name]
            if value is None:
                target[rows] = column.default
                continue
            try:
                target[rows] = value
            except ValueError:
                wanted = " x ".join(map(str, column.shape)) or "a single value"
                raise DeclarationError(
                    f"{self.kind.__name__}.{name} takes {wanted} per row, received an array of shape {value.shape}"
                ) from None

    def clear(self, rows: Any) -> None:
        """Unmark ``rows`` and zero them, so that nothing of a removed component lingers."""
        self.present[rows] = False
        for array in self.arrays.values():
            array[rows] = np.zeros((), array.dtype)
