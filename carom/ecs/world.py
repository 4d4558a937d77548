"""The world: one table per component, one per relation, one object per resource."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeVar, overload

import numpy as np

from carom.ecs.column import Booleans, Integers
from carom.ecs.component import Component, Record, Relation, Resource
from carom.ecs.components.name import Name
from carom.ecs.entity import INDEX_BITS, Entity, EntityView, generation_of, index_of, pack
from carom.ecs.errors import AccessError, DeclarationError, EntityError
from carom.ecs.query import Rows, find_rows
from carom.ecs.table import Table

if TYPE_CHECKING:
    from carom.ecs.system import System

R = TypeVar("R", bound=Record | Resource)


class World:
    """All state of one simulation.

    ``world[Kind]`` is the table of a component or relation (attributes are arrays of the whole capacity), or the
    resource of that class; outside of systems the arrays are read-only and `edit` writes. ``world[entity]`` reads one
    row like an object. Arrays are replaced when the table grows: fetch them anew after a spawn.
    """

    def __init__(self, *, capacity: int = 64) -> None:
        self.capacity = capacity
        self.tables: dict[type[Record], Table] = {}
        self.resources: dict[type[Resource], Resource] = {}
        self.generations: Integers = np.zeros(capacity, np.int64)
        self.alive = np.zeros(capacity, np.bool_)
        self.died_at: dict[int, int] = {}
        self.structure = 0
        self.frame = 0
        self.guards: dict[Any, dict[Any, Any]] = {}
        self.running: System | None = None
        self._used = 0
        self._free: list[int] = []
        self._queries: dict[Any, tuple[int, Rows, Integers]] = {}
        self._live: dict[Any, Any] = {}
        self._views: dict[Any, Any] = {}
        self._current = self._views

    # What is in it ----------------------------------------------------------------------------------------------------
    @overload
    def __getitem__(self, key: type[R]) -> R: ...
    @overload
    def __getitem__(self, key: int) -> EntityView: ...
    def __getitem__(self, key: Any) -> Any:
        """Return the table of a component or relation, the resource of a class, or the view of one entity."""
        try:
            return self._current[key]
        except KeyError:
            return self._open(key)

    def __contains__(self, kind: type[Record] | type[Resource]) -> bool:
        return kind in self.tables or kind in self.resources

    def _open(self, key: Any) -> Any:
        if isinstance(key, (int, np.integer)):
            self.row(int(key))
            return EntityView(self, Entity(int(key)))
        if isinstance(key, type) and issubclass(key, Record):
            self.table(key)
            return self._current[key]
        raise EntityError(f"the world has no resource {getattr(key, '__name__', key)!r}; add it with world.add(...)")

    def table(self, kind: type[Record]) -> Table:
        """Return the storage behind a kind, made on first use."""
        found = self.tables.get(kind)
        if found is None:
            found = Table(kind, self.capacity if issubclass(kind, Component) else 64)
            self.tables[kind] = found
            self._live[kind], self._views[kind] = found.live, found.view
        return found

    def add(self, resource: Resource) -> None:
        """Add or replace the resource of this class."""
        kind = type(resource)
        self.guards.clear()
        self.resources[kind] = self._live[kind] = self._views[kind] = resource

    @contextmanager
    def edit(self, kind: type[R]) -> Iterator[R]:
        """Lend the writable table of ``kind`` to code outside the step."""
        if self._current is not self._views:
            yield self[kind]
            return
        if issubclass(kind, Record):
            self.table(kind)
        yield self._live[kind]

    @contextmanager
    def faces(self, faces: dict[Any, Any] | None) -> Iterator[None]:
        """Show ``faces`` (None: everything writable) as ``world[Kind]`` while a system runs."""
        before, self._current = self._current, self._live if faces is None else faces
        try:
            yield
        finally:
            self._current = before

    # Entities -------------------------------------------------------------------------------------------------------
    def spawn(self, *bundles: Component, name: str | None = None) -> Entity:
        """Make one entity with these components; columns not given take their defaults."""
        return Entity(int(self.spawn_many(1, *bundles, names=None if name is None else [name])[0]))

    def spawn_many(self, count: int, *bundles: Component, names: list[str] | None = None) -> Integers:
        """Make ``count`` entities; a bundle's arrays hold one value for all, or one per entity along the first axis."""
        rows = self._reserve(count)
        try:
            for bundle in bundles:
                self.table(type(bundle)).fill(rows, bundle)
            if names is not None:
                self.table(Name).fill(rows, Name(text=names))
        except DeclarationError:
            self._release(rows)
            raise
        self.alive[rows] = True
        self.structure += 1
        return self.entities(rows)

    def _reserve(self, count: int) -> Integers:
        reused = [self._free.pop() for _ in range(min(count, len(self._free)))]
        fresh = range(self._used, self._used + count - len(reused))
        self._used = max(self._used, fresh.stop)
        if self._used > self.capacity:
            self.capacity = max(self._used, 2 * self.capacity)
            self.generations = np.concatenate(
                [self.generations, np.zeros(self.capacity - len(self.generations), np.int64)]
            )
            self.alive = np.concatenate([self.alive, np.zeros(self.capacity - len(self.alive), np.bool_)])
            for table in self.tables.values():
                if issubclass(table.kind, Component):
                    table.grow(self.capacity)
        return np.array([*reused, *fresh], np.int64)

    def despawn(self, *entities: int) -> None:
        """Remove entities with all their components; their handles are stale from now on."""
        rows = {entity: self.row(entity) for entity in entities}
        self._release(rows.values())
        for entity, row in rows.items():
            self.alive[row] = False
            self.died_at[entity] = self.frame
            self.generations[row] += 1
        self.structure += 1

    def _release(self, rows: Iterable[int]) -> None:
        """Clear rows of all components and keep them for the next entities, lowest first."""
        for row in rows:
            for table in self.tables.values():
                if issubclass(table.kind, Component) and table.present[row]:
                    table.clear(row)
            self._free.append(int(row))
        self._free.sort(reverse=True)

    def attach(self, entity: int, *bundles: Component) -> None:
        """Give a living entity further components."""
        row = self.row(entity)
        for bundle in bundles:
            self.table(type(bundle)).fill(row, bundle)
        self.structure += 1

    def detach(self, entity: int, *kinds: type[Component]) -> None:
        """Take components from a living entity."""
        row = self.row(entity)
        for kind in kinds:
            self.table(kind).clear(row)
        self.structure += 1

    def row(self, entity: int) -> int:
        """Return the row of a living entity; raise EntityError for a stale handle, saying when the entity went."""
        index = index_of(entity)
        if (
            entity >= 0
            and index < self._used
            and self.alive[index]
            and self.generations[index] == generation_of(entity)
        ):
            return index
        went = self.died_at.get(entity)
        when = "never was in this world" if went is None else f"was despawned in frame {went}"
        raise EntityError(f"entity {index}, generation {generation_of(entity)}, {when}")

    def entity(self, row: int) -> Entity:
        """Return the handle of the entity in ``row``."""
        return pack(int(row), int(self.generations[row]))

    def entities(self, rows: Any) -> Integers:
        """Return the handles of the entities in an array of rows."""
        handles: Integers = self.generations[rows] << INDEX_BITS | rows
        return handles

    def locate(self, entity: int, key: str) -> tuple[type[Component], int]:
        """Return the component called ``key`` (snake case) and the row of an entity that must have it."""
        row = self.row(entity)
        held = {
            kind.key: kind for kind, table in self.tables.items() if issubclass(kind, Component) and table.present[row]
        }
        if key not in held:
            raise EntityError(f"entity '{self.name(entity)}' has no {key}, only {', '.join(sorted(held))}")
        return held[key], row

    # Names ----------------------------------------------------------------------------------------------------------
    def name(self, entity: int) -> str:
        """Return the name of an entity, or its number in brackets when it has none."""
        row = index_of(entity)
        table = self.table(Name)
        text = str(table.arrays["text"][row]) if row < table.capacity and table.present[row] else ""
        return text or f"[{row}]"

    def find(self, name: str) -> Entity:
        """Return the entity of that name; raise EntityError with near names when there is none."""
        table = self.table(Name)
        hits = np.nonzero(table.arrays["text"][: self._used] == name)[0]
        if len(hits) and table.present[hits[0]]:
            return self.entity(hits[0])
        import difflib

        near = difflib.get_close_matches(name, self.names(), 3)
        hint = f"; did you mean {' or '.join(repr(n) for n in near)}?" if near else ""
        raise EntityError(f"no entity is named {name!r}{hint}")

    def names(self) -> list[str]:
        """Return all names in row order."""
        table = self.table(Name)
        return [str(text) for text in table.arrays["text"][: self._used][table.present[: self._used]]]

    # Queries --------------------------------------------------------------------------------------------------------
    def rows(self, *kinds: type[Component], without: Iterable[type[Component]] = ()) -> Rows:
        """Return the rows that have all ``kinds`` and none of ``without``: a slice where contiguous, else sorted."""
        return self._query(kinds, tuple(without))[1]

    def row_numbers(self, *kinds: type[Component], without: Iterable[type[Component]] = ()) -> Integers:
        """Return the same rows always as an int64 array, as kernels take them."""
        return self._query(kinds, tuple(without))[2]

    def _query(
        self, kinds: tuple[type[Component], ...], without: tuple[type[Component], ...]
    ) -> tuple[int, Rows, Integers]:
        found = self._queries.get((kinds, without))
        if found is None or found[0] != self.structure:
            masks = [self.table(kind).present[: self._used] for kind in kinds]
            absent = [self.table(kind).present[: self._used] for kind in without]
            found = (self.structure, *find_rows(self.alive[: self._used], masks, absent))
            self._queries[kinds, without] = found
        return found

    def count(self, kind: type[Record]) -> int:
        """Return how many rows a kind has."""
        if issubclass(kind, Relation):
            view = self.table(kind).view
            assert isinstance(view, Relation)
            return view.count
        return int(self.table(kind).present[: self._used].sum())

    def resize(self, kind: type[Relation], count: int) -> None:
        """Set the row count of a relation; only systems that write it may."""
        if kind in self.tables and self.count(kind) == count:
            return
        if self._current is not self._live and self._current.get(kind) is not self.table(kind).live:
            raise AccessError(f"only a system that writes {kind.__name__} may resize it")
        self.table(kind).resize(count)

    def used(self) -> int:
        """Return one more than the highest row ever used."""
        return self._used

    def reset(self, alive: Booleans, generations: Integers, frame: int) -> None:
        """Set who lives, for `restore_snapshot`; the tables are then filled by it."""
        self._used = 0
        self._free = []
        self._reserve(len(alive))
        self.alive[:] = False
        self.alive[: self._used], self.generations[: self._used] = alive, generations
        self._free = [int(row) for row in np.nonzero(~alive)[0][::-1]]
        self.frame = frame
        self.structure += 1
