"""Slots: which row every entity has, which handles live, and which rows are free."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Booleans, Integers
from carom.ecs.entity import INDEX_BITS, INDEX_MASK, Entity
from carom.ecs.errors import EntityError

Rows = slice | Integers
SAVED = ("generations", "died_at", "id_shift")


def as_rows(rows: Integers) -> Rows:
    """Return sorted rows as a slice where they are contiguous: 60 times cheaper to index by at 100,000 rows."""
    if not len(rows):
        return slice(0, 0)
    first, last = int(rows[0]), int(rows[-1])
    return slice(first, last + 1) if last - first + 1 == len(rows) else rows


def as_numbers(rows: Rows) -> Integers:
    """Return rows always as an array (n,); the inverse of `as_rows`."""
    return np.arange(rows.start, rows.stop) if isinstance(rows, slice) else rows


class Slots:
    """Rows, the ids that handles carry, and the generation of each id.

    Row *r* belongs to id ``r + id_shift[r]`` and id *i* to row ``i + row_shift[i]``; a free row keeps its id for the
    entity that comes next. Shifts are zero until `compact`, so that these arrays cost no memory before.
    """

    def __init__(self, capacity: int) -> None:
        self.capacity = 0
        self.used = 0  # one more than the highest row in use
        self.reached = 0  # the most that was ever used: beyond it every row is as it was made
        self.alive: Booleans = np.zeros(0, np.bool_)
        self.generations: npt.NDArray[np.int32] = np.zeros(0, np.int32)  # by id, as died_at and row_shift
        self.died_at: Integers = np.zeros(0, np.int64)
        self.id_shift: npt.NDArray[np.int32] = np.zeros(0, np.int32)
        self.row_shift: npt.NDArray[np.int32] = np.zeros(0, np.int32)
        self._free: Integers | None = None
        self.grow(capacity)

    def grow(self, capacity: int) -> None:
        """Make room for ``capacity`` rows."""
        for name in ("alive", "generations", "died_at", "id_shift", "row_shift"):
            old = getattr(self, name)
            new = np.zeros(capacity, old.dtype)
            new[: self.reached] = old[: self.reached]
            setattr(self, name, new)
        self.capacity = capacity

    def choose(self, count: int) -> Rows:
        """Return ``count`` free rows in a row: the lowest gap that holds them, else new ones at the end."""
        free = self.free()
        if len(free) >= count > 0:
            starts = np.nonzero(free[count - 1 :] - free[: len(free) - count + 1] == count - 1)[0]
            if len(starts):
                first = int(free[starts[0]])
                return slice(first, first + count)
        return slice(self.used, self.used + count)

    def free(self) -> Integers:
        """Return the free rows below the highest used one, sorted."""
        if self._free is None:
            self._free = np.nonzero(~self.alive[: self.used])[0].astype(np.int64)
        return self._free

    def occupy(self, rows: slice) -> None:
        """Let new entities live in free ``rows``."""
        free = self.free()
        self.alive[rows] = True
        if rows.start < self.used:
            at = int(np.searchsorted(free, rows.start))
            self._free = np.delete(free, slice(at, at + rows.stop - rows.start))
        self.used = max(self.used, rows.stop)
        self.reached = max(self.reached, self.used)

    def release(self, rows: Integers, frame: int) -> None:
        """Let the entities in ``rows`` be gone; their handles are stale from now on."""
        ids = self.ids(rows)
        self.alive[rows] = False
        self.generations[ids] += 1
        self.died_at[ids] = frame
        while self.used and not self.alive[self.used - 1]:
            block = self.alive[max(self.used - 4096, 0) : self.used]
            self.used -= int(block[::-1].argmax()) if block.any() else len(block)
        self._free = None

    def compact(self) -> Integers:
        """Move the living to the front in their order; return the old row of each."""
        living = np.nonzero(self.alive[: self.used])[0].astype(np.int64)
        dead = np.nonzero(~self.alive[: self.reached])[0]
        ids = self.ids(np.concatenate([living, dead]))
        rows = np.arange(self.reached)
        self.id_shift[: self.reached] = ids - rows
        self.row_shift[ids] = rows - ids
        self.alive[: self.used] = False
        self.used = len(living)
        self.alive[: self.used] = True
        self._free = None
        return living

    def state(self) -> dict[str, npt.NDArray[Any]]:
        """Return what a snapshot must keep: who lives, and what handles were given out."""
        kept = {name: getattr(self, name)[: self.reached].copy() for name in SAVED}
        return {"alive": self.alive[: self.used].copy(), **kept}

    def restore(self, state: dict[str, npt.NDArray[Any]]) -> None:
        """Take back what `state` returned; there is room for it."""
        self.alive[:] = False
        for name in SAVED:
            array = getattr(self, name)
            array[:] = 0
            array[: len(state[name])] = state[name]
        self.used, self.reached = len(state["alive"]), len(state["generations"])
        self.alive[: self.used] = state["alive"]
        rows = np.arange(self.reached)
        self.row_shift[:] = 0
        self.row_shift[self.ids(rows)] = -self.id_shift[: self.reached]
        self._free = None

    def ids(self, rows: Any) -> Integers:
        """Return the id of each row."""
        return np.asarray(as_numbers(rows) + self.id_shift[rows], np.int64)

    def entities(self, rows: Any) -> Integers:
        """Return the handles of the entities in ``rows``."""
        ids = self.ids(rows)
        handles = self.generations[ids].astype(np.int64)
        handles <<= INDEX_BITS
        handles |= ids
        return handles

    def live(self, entities: Any) -> Booleans:
        """Return for each handle whether it leads to a living entity."""
        handles = np.asarray(entities, np.int64)
        ids = handles & INDEX_MASK
        known: Booleans = (handles >= 0) & (ids < self.reached)
        ids = np.where(known, ids, 0)
        known &= self.alive[ids + self.row_shift[ids]] & (self.generations[ids] == handles >> INDEX_BITS)
        return known

    def rows(self, entities: Any) -> Integers:
        """Return the row of each living entity; raise EntityError for the first that does not live."""
        handles = np.asarray(entities, np.int64)
        live = self.live(handles)
        if not live.all():
            raise EntityError(self.fate(int(handles.ravel()[np.argmin(live)])))
        return self.rows_of_living(handles)

    def rows_of_living(self, entities: Integers) -> Integers:
        """Return the row of each entity, all of which are known to live."""
        ids = entities & INDEX_MASK
        return np.asarray(ids + self.row_shift[ids])

    def row(self, entity: int) -> int:
        """Return the row of one living entity; the fast form of `rows`."""
        if self.lives(entity):
            index = entity & INDEX_MASK
            return index + int(self.row_shift[index])
        raise EntityError(self.fate(entity))

    def lives(self, entity: int) -> bool:
        """Return whether one handle leads to a living entity; the fast form of `live`."""
        index = entity & INDEX_MASK
        known = entity >= 0 and index < self.reached and self.generations[index] == entity >> INDEX_BITS
        return bool(known and self.alive[index + int(self.row_shift[index])])

    def fate(self, entity: int) -> str:
        """Say in words what became of an entity that does not live."""
        if entity < 0:
            return f"{entity} is no entity: handles are 0 or more, and -1 stands for none"
        index, generation = entity & INDEX_MASK, entity >> INDEX_BITS
        when = "never was in this world"
        if index < self.reached and generation < self.generations[index]:
            earlier = generation < self.generations[index] - 1
            when = f"was despawned {'before' if earlier else 'in'} frame {self.died_at[index]}"
        return f"entity {index}, generation {generation}, {when}"

    def entity(self, row: int) -> Entity:
        """Return the handle of the entity in one row."""
        index = int(row) + int(self.id_shift[row])
        return Entity(int(self.generations[index]) << INDEX_BITS | index)
