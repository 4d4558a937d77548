"""Structure: entities come and go, components are attached and detached, rows are kept together."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from carom.ecs.changes import Watch
from carom.ecs.column import Integers
from carom.ecs.component import Component, Record
from carom.ecs.components.name import Name
from carom.ecs.entity import Entity
from carom.ecs.errors import AccessError, DeclarationError
from carom.ecs.hierarchy import descendants
from carom.ecs.names import NOBODY, Names
from carom.ecs.prefab import Prefab, merge
from carom.ecs.query import Query, as_handles
from carom.ecs.slots import Rows, Slots
from carom.ecs.table import Table

if TYPE_CHECKING:
    from carom.ecs.system import System
    from carom.ecs.writes import WriteLog


class Structure:
    """The rows of a world and what stands in them; `World` adds access, names and queries."""

    def __init__(self, capacity: int) -> None:
        self.slots = Slots(max(capacity, 1))
        self.tables: dict[type[Record], Table] = {}
        self.structure = 0  # grows whenever entities or components come or go
        self.restored = 0  # grows with every snapshot restored
        self.edited: set[type[Record]] = set()  # what code outside the step has opened since the last step
        self.writes: WriteLog | None = None
        self.frame = 0
        self.running: System | None = None
        self.entity_names = Names()
        self._watches: dict[type[Component], Watch] = {}
        self._handles: tuple[int, Integers] = (-1, np.zeros(0, np.int64))
        self._own_rows: dict[type[Component], tuple[int, Integers]] = {}  # in which structure they were found, and they

    def table(self, kind: type[Record]) -> Table:
        """Return the storage behind a kind, made on first use."""
        found = self.tables.get(kind)
        if found is None:
            found = self.tables[kind] = Table(kind, self.slots.capacity if issubclass(kind, Component) else 64)
        return found

    def spawn(self, *bundles: Component | Prefab, name: str | None = None) -> Entity:
        """Make one entity with these components; columns not given take their defaults."""
        return Entity(int(self.spawn_many(1, *bundles, names=None if name is None else [name])[0]))

    def spawn_many(self, count: int, *bundles: Component | Prefab, names: list[str] | None = None) -> Integers:
        """Make ``count`` entities in rows next to each other and return their handles (count,).

        A bundle's arrays hold one value for all, or one per entity along the first axis. Raises DeclarationError for
        values that do not fit their column and for names that are taken, EntityError for values that lead to no entity.
        """
        self._refuse_inside("spawn")
        if count < 0:
            raise DeclarationError(f"spawn_many makes 0 entities or more, received {count}")
        if names is not None and len(names) != count:
            raise DeclarationError(f"names: one for each of {count} entities, received {len(names)}")
        parts = merge(bundles if names is None else (*bundles, Name(text=names)))
        self._check(parts, count)
        rows = self.slots.choose(count)
        assert isinstance(rows, slice)
        if rows.stop > self.slots.capacity:
            self._grow(max(rows.stop, 2 * self.slots.capacity))
        self.slots.occupy(rows)
        self._fill(rows, parts)
        return self.entities(rows)

    def despawn(self, *entities: int | Integers | Query) -> None:
        """Remove entities, one by one, as arrays of handles or as queries, and everyone they carry.

        Their handles are stale from now on.
        """
        self._refuse_inside("despawn")
        named = np.concatenate([np.zeros(0, np.int64), *map(as_handles, entities)])
        rows = self.slots.rows(named)  # raises before anything has changed
        family = descendants(self, named)
        rows = self._sorted(rows if family is named else self.slots.rows(family))
        self._forget_names(rows)
        for table in self._components():
            if len(held := rows[table.present[rows]]):
                table.clear(held)
        self.slots.release(rows, self.frame)
        self.structure += 1

    def _sorted(self, rows: Integers) -> Integers:
        """Return each of ``rows`` once, in order; where they are many a mask is 10 times faster than `numpy.unique`."""
        if 64 * len(rows) < self.used():
            return np.unique(rows)
        mask = np.zeros(self.used(), np.bool_)
        mask[rows] = True
        return np.nonzero(mask)[0]

    def attach(self, entities: int | Integers | Query, *bundles: Component | Prefab) -> None:
        """Give one entity, or all of an array of handles or a query, further components in the place of those it has.

        A bundle's arrays hold one value for all, or one per entity along the first axis, as in `spawn_many`.
        """
        self._refuse_inside("attach")
        handles, parts = as_handles(entities), merge(bundles)
        rows = self.slots.rows(handles)
        self._check(parts, len(rows), int(handles[0]) if len(rows) == 1 else NOBODY)
        if any(isinstance(part, Name) for part in parts):
            self._forget_names(rows)
        self._fill(rows, parts)

    def detach(self, entities: int | Integers | Query, *kinds: type[Component]) -> None:
        """Take components from one entity, or from all of an array of handles or a query; to have none is no fault."""
        self._refuse_inside("detach")
        rows = self.slots.rows(as_handles(entities))
        if Name in kinds:
            self._forget_names(rows)
        for kind in kinds:
            self.table(kind).clear(rows)
        self.structure += 1

    def compact(self) -> None:
        """Move all entities to the first rows, in their order, so that no gaps are left where others were.

        Handles stay valid, queries find contiguous rows again where they can, and what follows is the same to the last
        bit, since no result depends on more than the order of rows. Those who come later come last: no gap is left.
        """
        self._refuse_inside("compact")
        used = self.slots.used
        rows = self.slots.compact()
        new_rows = np.full(used, -1)
        new_rows[rows] = np.arange(len(rows))
        for table in self._components():
            table.gather(rows, used)
        for table in self.tables.values():
            table.renumber(new_rows)
        self.structure += 1

    def begin_restore(self, slots: dict[str, npt.NDArray[Any]], frame: int, edited: frozenset[type[Record]]) -> None:
        """Let those live who lived when ``slots`` was saved; the tables are then filled by `restore_snapshot`."""
        if (reached := len(slots["generations"])) > self.slots.capacity:
            self._grow(reached)
        self.slots.restore(slots)
        self.entity_names.stale = True
        self.frame = frame
        self.structure += 1
        self.restored += 1
        self.edited = set(edited)
        if self.writes is not None:
            self.writes.forget()

    def _refuse_inside(self, verb: str) -> None:
        if self.running is not None:
            raise AccessError(
                f"system '{self.running.name}' asks the world to {verb} while the step runs; "
                f"ask for it instead: world[Commands].ask(lambda world: world.{verb}(...)), with Commands in writes="
            )

    def _check(self, parts: list[Component], count: int, entity: int = NOBODY) -> None:
        for part in parts:
            for name, value in vars(part).items():
                column = part.columns[name]
                column.fit(value, count, f"{type(part).__name__}.{name}")
                if column.holds == "entities":
                    self.slots.rows(value[value >= 0])
            if isinstance(part, Name) and "text" in vars(part):
                self.names_now().refuse_taken(np.broadcast_to(part.text, count).tolist(), entity)

    def _fill(self, rows: Rows, parts: list[Component]) -> None:
        for part in parts:
            self.table(type(part)).fill(rows, part)
            if isinstance(part, Name):
                self.entity_names.note(self.table(Name).arrays["text"][rows], self.entities(rows))
        self.structure += 1

    def _grow(self, capacity: int) -> None:
        used = self.slots.used
        self.slots.grow(capacity)
        for table in self._components():
            table.grow(capacity, used)

    def _components(self) -> Iterator[Table]:
        return (table for table in self.tables.values() if issubclass(table.kind, Component))

    # Handles and rows -------------------------------------------------------------------------------------------------
    def row(self, entity: int) -> int:
        """Return the row of a living entity; raise EntityError for a stale handle, saying when the entity went."""
        return self.slots.row(entity)

    def entity(self, row: int) -> Entity:
        """Return the handle of the entity in ``row``."""
        return self.slots.entity(row)

    def entities(self, rows: Any) -> Integers:
        """Return the handles of the entities in an array or slice of rows."""
        return self.slots.entities(rows)

    def handles(self) -> Integers:
        """Return the handle of every row in use, also of free ones: an array to look handles up in by row."""
        if self._handles[0] != self.structure:
            self._handles = (self.structure, self.entities(slice(0, self.used())))
        return self._handles[1]

    def own_rows(self, kind: type[Component]) -> Integers:
        """Return for each row in use its own number where it has a component, -1 where not; not to be written to."""
        known = self._own_rows.get(kind)
        if known is None or known[0] != self.structure:
            there = self.table(kind).present[: self.used()]
            known = self._own_rows[kind] = self.structure, np.where(there, np.arange(len(there)), -1)
        return known[1]

    def used(self) -> int:
        """Return one more than the highest row in use."""
        return self.slots.used

    @property
    def capacity(self) -> int:
        """How many rows there is room for."""
        return self.slots.capacity

    def components(self, entity: int) -> list[type[Component]]:
        """Return the components of a living entity, in order of their names."""
        row = self.row(entity)
        return sorted((t.kind for t in self._components() if t.present[row]), key=lambda kind: kind.key)  # type: ignore[misc]

    def names_now(self) -> Names:
        """Return the index of names, made anew when somebody edited them."""
        if self.entity_names.stale:
            table = self.table(Name)
            rows = np.nonzero(table.present[: self.used()])[0]
            self.entity_names.entities = {}
            self.entity_names.note(table.arrays["text"][rows], self.entities(rows))
            self.entity_names.stale = False
        return self.entity_names

    def _forget_names(self, rows: Integers) -> None:
        table = self.table(Name)
        for text in table.arrays["text"][rows[table.present[rows]]].tolist():
            self.entity_names.entities.pop(text, None)
