"""Arguments of queries: arrays of as many rows each, and every fault of them told at once."""

from __future__ import annotations

from functools import reduce
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Booleans, Floats
from carom.ecs.errors import CaromError
from carom.systems.constants import FARTHEST_QUERY

TOLD = 5  # rows of a fault that are named


class QueryError(CaromError):
    """A query was asked with numbers that mean nothing."""


class Arguments:
    """The arrays of one query, named as its caller knows them; `settle` raises what is wrong with any of them."""

    def __init__(self, query: str) -> None:
        self.query = query
        self.faults: list[str] = []

    def vectors(self, name: str, values: npt.ArrayLike, width: int = 3) -> Floats:
        """Return rows (n, width) of finite numbers; one row (width,) is that of all."""
        found = self._rows(name, values, (width,))
        self._refuse_far(name, found, FARTHEST_QUERY, f"finite and at most {FARTHEST_QUERY:g}")
        return found

    def directions(self, name: str, values: npt.ArrayLike, width: int = 3) -> Floats:
        """Return rows (n, width) at length 1."""
        found = self._rows(name, values, (width,))
        self._refuse_far(name, found, float(np.finfo(np.float64).max), "finite")
        columns = found.T
        largest: Floats = reduce(np.maximum, np.abs(columns))
        self._refuse(name, np.equal(largest, 0.0), found, "must have a direction, received a zero vector")
        scaled = columns / np.where(largest > 0.0, largest, 1.0)  # so that no square is too large or too small
        squared = reduce(np.add, scaled * scaled)
        return np.ascontiguousarray((scaled / np.sqrt(np.where(squared > 0.0, squared, 1.0))).T)

    def lengths(self, name: str, values: npt.ArrayLike) -> Floats:
        """Return rows (n,) of lengths, m, 0 and infinity among them."""
        found = self._rows(name, values, ())
        wrong = ~(found >= 0.0)
        self._refuse(name, wrong, found, "must be 0 m or more, received")
        return found

    def settle(self, *columns: Floats) -> list[Floats]:
        """Return the columns with as many rows each; raise QueryError where anything is wrong, with all of it."""
        counts = {len(column) for column in columns if column.shape[0] != 1} or {1}
        if len(counts) > 1 and not self.faults:
            received = ", ".join(str(len(column)) for column in columns)
            self.faults.append(f"rows: must be as many of each, or one for all, received {received}")
        if self.faults:
            raise QueryError("\n".join(f"{self.query}: {fault}" for fault in self.faults))
        n = counts.pop()
        return [np.array(np.broadcast_to(column, (n, *column.shape[1:])), order="C") for column in columns]

    def _rows(self, name: str, values: npt.ArrayLike, shape: tuple[int, ...]) -> Floats:
        wanted = f"(n, {shape[0]})" if shape else "(n,)"
        try:
            found = np.asarray(values)
        except ValueError:  # rows of different lengths
            found = np.asarray(None)
        if found.dtype.kind not in "fiu":
            self.faults.append(f"{name}: must be numbers {wanted}, received {values!r}")
            return np.ones((0, *shape))
        if found.shape == shape:
            found = found[None]
        if found.ndim != 1 + len(shape) or found.shape[1:] != shape:
            self.faults.append(f"{name}: must have the shape {wanted}, received {found.shape}")
            return np.ones((0, *shape))
        return np.array(found, np.float64)

    def _refuse_far(self, name: str, found: Floats, most: float, wanted: str) -> None:
        near: Booleans = np.abs(found) <= most
        if not near.all():
            self._refuse(name, ~np.all(near, axis=1), found, f"must be {wanted}, received")
            found[~near] = 1.0

    def _refuse(self, name: str, wrong: Booleans, found: Any, fault: str) -> None:
        rows = np.nonzero(wrong)[0].tolist()
        if not rows:
            return
        more = f" and {len(rows) - TOLD} more" if len(rows) > TOLD else ""
        listed = ", ".join(map(str, rows[:TOLD])) + more
        received = f" {found[rows[0]].tolist()}" if fault.endswith("received") else ""
        self.faults.append(f"{name}: {fault}{received} in row{'s' if len(rows) > 1 else ''} {listed}")
