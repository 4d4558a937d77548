"""The world: one table per component, one per relation, one object per resource."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import chain
from typing import Any, TypeVar, cast, overload

import numpy as np

from carom.ecs.changes import Watch
from carom.ecs.column import Integers, Texts
from carom.ecs.component import Component, Record, Relation, Resource
from carom.ecs.components.name import Name
from carom.ecs.components.parent import Parent
from carom.ecs.describe import describe, describe_world
from carom.ecs.display import world_html
from carom.ecs.entity import INDEX_MASK, Entity, EntityView
from carom.ecs.errors import AccessError, DeclarationError, EntityError
from carom.ecs.names import pattern
from carom.ecs.query import Key, Kinds, Query, Several, as_kinds
from carom.ecs.slots import Rows, as_rows
from carom.ecs.structure import Structure
from carom.ecs.table import Table

R = TypeVar("R", bound=Record | Resource)


class World(Structure):
    """All state of one simulation.

    ``world[Kind]`` is the table of a component or relation (attributes are arrays of the whole capacity), or the
    resource of that class; outside of systems the arrays are read-only and `edit` writes. ``world[entity]`` reads one
    row like an object. Arrays are replaced when the table grows: fetch them anew after a spawn.
    """

    def __init__(self, *, capacity: int = 64) -> None:
        super().__init__(capacity)
        self.resources: dict[type[Resource], Resource] = {}
        self.guards: dict[Any, dict[Any, Any]] = {}
        self._queries: dict[Key, Query] = {}
        self._rows_of: dict[Several, tuple[int, Integers]] = {}  # as they were found, and in which structure
        self._mark = 0
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

    def __contains__(self, key: object) -> bool:
        """Tell whether a component, relation or resource is here, or whether an entity lives."""
        if isinstance(key, (int, np.integer)):
            return self.slots.lives(int(key))
        return key in self.tables or key in self.resources

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
            found = super().table(kind)
            self._live[kind], self._views[kind] = found.live, found.view
            found.live._world = found.view._world = self
        return found

    def add(self, resource: Resource) -> None:
        """Add or replace the resource of this class."""
        kind = type(resource)
        self.guards.clear()
        self.resources[kind] = self._live[kind] = self._views[kind] = resource

    @contextmanager
    def edit(self, kind: type[R]) -> Iterator[R]:
        """Lend the writable table of ``kind`` to code outside the step; inside, systems see what they declare."""
        self[kind]  # makes the table, or raises for what is not here or not declared
        if self.running is None:
            self.edited.add(cast(type[Record], kind))
            if self.writes is not None:
                self.writes.open(self, cast(type[Record], kind))
        try:
            yield self._live[kind] if self._current is self._views else self._current[kind]
        finally:
            self.entity_names.stale |= kind is Name

    def faces(self, faces: dict[Any, Any] | None) -> Faces:
        """Show ``faces`` (None: everything writable) as ``world[Kind]`` while a system runs: a context."""
        return Faces(self, self._live if faces is None else faces)

    # Single entities and names ----------------------------------------------------------------------------------------
    def locate(self, entity: int, key: str) -> tuple[type[Component], int]:
        """Return the component called ``key`` (snake case) and the row of an entity that must have it."""
        kind, row = Record.registry.get(key), self.row(entity)
        if kind in self.tables and issubclass(kind, Component) and self.tables[kind].present[row]:
            return kind, row
        for held in self.components(entity):  # registered by a class that is gone, or by another of that name
            if held.key == key:
                return held, row
        listed = ", ".join(kind.key for kind in self.components(entity)) or "no component at all"
        raise EntityError(f"entity '{self.name(entity)}' has no {key}, only {listed}")

    def children(self, entity: int) -> Integers:
        """Return the handles of those an entity carries directly, in order of rows."""
        rows = self.row_numbers(Parent)
        return self.entities(rows[self.table(Parent).arrays["entity"][rows] == entity])

    def name(self, entity: int) -> str:
        """Return the name of an entity, or its number in brackets when it has none; a stale handle has none."""
        if entity in self:
            row, table = self.row(entity), self.table(Name)
            if table.present[row] and table.arrays["text"][row]:
                return str(table.arrays["text"][row])
        return f"[{int(entity) & INDEX_MASK}]"

    def names_told(self, entities: Integers) -> list[str]:
        """Return what `name` returns of each of many entities (n,)."""
        numbers = (entities & INDEX_MASK).tolist()
        return [text or f"[{number}]" for text, number in zip(self.names_of(entities).tolist(), numbers, strict=True)]

    def names_of(self, entities: Integers) -> Texts:
        """Return the name of each of many entities (n,), empty where one has none or lives no more."""
        live, texts = self.slots.live(entities), self.table(Name).arrays["text"]
        names = np.zeros(len(live), texts.dtype)
        names[live] = texts[self.slots.rows(entities[live])]
        return names

    def describe(self, entity: int) -> str:
        """Return an entity in words: each component with its values, tags, whom it carries.

        Values come with unit and meaning, those at their default in short. Raises EntityError for a stale handle.
        """
        return describe(self, entity)

    def __repr__(self) -> str:
        return describe_world(self)

    def _repr_html_(self) -> str:
        return world_html(self)

    def find(self, name: str) -> Entity:
        """Return the entity of that name; raise EntityError with near names when there is none."""
        found = self.names_now().entities.get(name)
        if found is None or self.name(found) != name:
            self.entity_names.stale = True  # a system may have written names
        return Entity(self.names_now().find(name))

    def find_all(self, text: str) -> Integers:
        """Return the entities a pattern means, in order of rows; none is an empty array.

        A pattern is a name, the name of all copies (``rain`` for ``rain[3,0,1]``), or holds ``*`` for any text.
        """
        fits, rows = pattern(text).fullmatch, self.row_numbers(Name)
        texts = self.table(Name).arrays["text"][rows].tolist()
        return self.entities(rows[[bool(text and fits(text)) for text in texts]] if len(rows) else rows)

    def names(self) -> list[str]:
        """Return all names in row order."""
        names: list[str] = self.table(Name).arrays["text"][self.row_numbers(Name)].tolist()
        return [name for name in names if name]

    # Queries ----------------------------------------------------------------------------------------------------------
    def rows(
        self, *kinds: type[Component], without: Kinds = (), any_of: Kinds = (), changed_since: int | None = None
    ) -> Rows:
        """Return the rows that have all ``kinds``, none of ``without`` and, if given, one of ``any_of``.

        The result is a slice where they are contiguous, else a sorted array. ``changed_since`` keeps those where one of
        ``kinds`` came or holds something else since that `mark`.
        """
        query = self._query(kinds, without, any_of, ())
        return query.rows if changed_since is None else as_rows(self._changed(query, changed_since))

    def row_numbers(
        self, *kinds: type[Component], without: Kinds = (), any_of: Kinds = (), changed_since: int | None = None
    ) -> Integers:
        """Return the same rows always as an int64 array, as kernels take them."""
        guarded = self._current is not self._live and self._current is not self._views
        if guarded or without or any_of or changed_since is not None:
            query = self._query(kinds, without, any_of, ())
            return query.numbers if changed_since is None else self._changed(query, changed_since)
        known = self._rows_of.get(kinds)  # many times in each step
        if known is None or known[0] != self.structure:
            known = self._rows_of[kinds] = self.structure, self._query(kinds, (), (), ()).numbers
        return known[1]

    def query(self, *kinds: type[Component], without: Kinds = (), any_of: Kinds = (), optional: Kinds = ()) -> Query:
        """Return the entities of such rows as an object that stays right: rows, handles, a loop, a dataframe."""
        return self._query(kinds, without, any_of, optional)

    def mark(self, *kinds: type[Component]) -> int:
        """Return a mark for ``changed_since``; the components named are watched from the first mark on."""
        self._look()
        self._mark += 1
        for kind in kinds:
            if kind not in self._watches:
                self._watches[kind] = Watch(self.table(kind), self.handles(), self._mark)
        return self._mark

    def _look(self) -> None:
        for watch in self._watches.values():
            watch.look(self.handles(), self._mark)

    def _changed(self, query: Query, mark: int) -> Integers:
        watches = self._watches
        unwatched = [kind.__name__ for kind in query.kinds if kind not in watches or watches[kind].first > mark]
        if unwatched:
            listed = ", ".join(unwatched)
            raise AccessError(
                f"nobody watched {listed} at mark {mark}; take the mark with world.mark({listed}) before things change"
            )
        self._look()
        numbers = query.numbers
        changed = np.zeros(len(numbers), np.bool_)
        for kind in query.kinds:
            changed |= watches[kind].changed_after[numbers] >= mark
        return np.asarray(numbers[changed])

    def _query(self, kinds: tuple[type[Component], ...], without: Kinds, any_of: Kinds, optional: Kinds) -> Query:
        key = kinds, as_kinds(without), as_kinds(any_of), as_kinds(optional)
        if self._current is not self._live and self._current is not self._views:
            for kind in chain(*key):
                self._current[kind]  # raises for what the running system does not declare
        found = self._queries.get(key)
        if found is None:
            for kind in chain(*key):
                if not (isinstance(kind, type) and issubclass(kind, Component)):
                    raise DeclarationError(f"a query takes component classes, received {kind!r}")
            found = self._queries[key] = Query(self, *key)
        return found

    # Relations --------------------------------------------------------------------------------------------------------
    def count(self, kind: type[Record]) -> int:
        """Return how many rows a kind has."""
        if issubclass(kind, Relation):
            view = self.table(kind).view
            assert isinstance(view, Relation)
            return view.count
        return int(np.count_nonzero(self.table(kind).present[: self.used()]))

    def resize(self, kind: type[Relation], count: int) -> None:
        """Set the row count of a relation; only systems that write it may."""
        table = self.table(kind)
        if table.counted[0].count == count:
            return
        if self._current is not self._live and self._current.get(kind) is not table.live:
            raise AccessError(f"only a system that writes {kind.__name__} may resize it")
        table.resize(count)


class Faces:
    """What `World.faces` shows, until the context ends; a class, since a generator takes a microsecond."""

    __slots__ = ("before", "faces", "world")

    def __init__(self, world: World, faces: dict[Any, Any]) -> None:
        self.world, self.faces = world, faces

    def __enter__(self) -> None:
        self.before, self.world._current = self.world._current, self.faces

    def __exit__(self, *fault: object) -> None:
        self.world._current = self.before
