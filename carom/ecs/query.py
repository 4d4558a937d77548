"""Queries: the entities that have these components, as rows, as handles and one by one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from carom.ecs.column import Booleans, Integers
from carom.ecs.component import Component
from carom.ecs.dataframe import Dataframe, query_table
from carom.ecs.describe import describe_query
from carom.ecs.display import query_html
from carom.ecs.entity import Entity, EntityView
from carom.ecs.errors import AccessError
from carom.ecs.slots import Rows, as_rows

if TYPE_CHECKING:
    from pyarrow import Table

    from carom.ecs.world import World

Kinds = type[Component] | Iterable[type[Component]]
Several = tuple[type[Component], ...]
Key = tuple[Several, Several, Several, Several]


def as_kinds(kinds: Kinds) -> tuple[type[Component], ...]:
    """Return one or several components as a tuple."""
    return (kinds,) if isinstance(kinds, type) else tuple(kinds)


def as_handles(entities: int | Integers | Query) -> Integers:
    """Return one entity, an array of handles or those a query finds as handles (n,)."""
    return entities.entities if isinstance(entities, Query) else np.atleast_1d(np.asarray(entities, np.int64))


class Query(Dataframe):
    """The entities that have all ``kinds``, none of ``without`` and, if given, at least one of ``any_of``.

    It stays right as entities come and go: rows are found anew when the structure has changed since they were asked
    for. ``optional`` components select nothing; they are shown where an entity has them.
    """

    def __init__(
        self,
        world: World,
        kinds: Several,
        without: Several,
        any_of: Several,
        optional: Several,
    ) -> None:
        self.world, self.kinds, self.without = world, kinds, without
        self.any_of, self.optional = any_of, optional
        self.structure = -1
        self._rows: Rows
        self._numbers: Integers

    @property
    def rows(self) -> Rows:
        """The rows: a slice where they are contiguous, else sorted."""
        if self.structure != self.world.structure:
            self._find()
        return self._rows

    @property
    def numbers(self) -> Integers:
        """The rows always as an array (n,), as kernels take them.

        A kernel is fastest on any rows when it runs from the first to the last where these are contiguous, and else
        over the rows one by one: ``carom/tools/bench/table_loops.py`` shows how.
        """
        if self.structure != self.world.structure:
            self._find()
        return self._numbers

    @property
    def entities(self) -> Integers:
        """The handles (n,), in order of rows."""
        return self.world.entities(self.numbers)

    def has(self, kind: type[Component]) -> Booleans:
        """Return for each row whether the entity has ``kind``: a mask (n,)."""
        self.world[kind]  # raises for what the running system does not declare
        return np.asarray(self.world.table(kind).present[self.numbers])

    def arrow(self) -> Table:
        """Return the entities with these components, optional ones null where they lack them; see `Dataframe.arrow`."""
        return query_table(self)

    def __repr__(self) -> str:
        return describe_query(self)

    def _repr_html_(self) -> str:
        return query_html(self)

    def __len__(self) -> int:
        return len(self.numbers)

    def __iter__(self) -> Iterator[EntityView]:
        """Yield each entity like an object; the structure must stay as it is until the end."""
        structure = self.world.structure
        for entity in self.entities.tolist():
            if self.world.structure != structure:
                raise AccessError(
                    "entities came, went or changed their components while a query was iterated over; "
                    "iterate over list(query), or ask for the change: world[Commands].spawn(...)"
                )
            yield EntityView(self.world, Entity(entity))

    def _find(self) -> None:
        world = self.world
        used = world.used()
        match = world.slots.alive[:used].copy()
        for kind in self.kinds:
            match &= world.table(kind).present[:used]
        for kind in self.without:
            match &= ~world.table(kind).present[:used]
        if self.any_of:
            match &= np.logical_or.reduce([world.table(kind).present[:used] for kind in self.any_of])
        self._numbers = np.nonzero(match)[0].astype(np.int64, copy=False)
        self._rows = as_rows(self._numbers)
        self.structure = world.structure
