"""Casts: those of some names in the course of a run, in which events bring and remove entities."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from carom.ecs import World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.names import NOBODY
from carom.worlds.comers import all_names, still_to_come
from carom.worlds.names import matching

MOST_TOLD = 3  # names in a message


class Cast:
    """Those of some names: each has a row while somebody of that name is there; ``known`` are all who have been."""

    def __init__(self, names: Iterable[str], world: World) -> None:
        self.names = tuple(names)
        self.known: set[int] = set()  # handles
        self._seen = (-1, -1)
        self._rows: Integers = np.zeros(0, np.int64)
        self._there, self._every, self._some = (np.zeros(0, np.bool_) for _ in range(3))
        self.rows(world)

    def rows(self, world: World) -> Integers:
        """Return the row of each (n,), -1 of who is not there; looked up again only where rows may have changed."""
        if self._seen != (world.structure, world.restored):
            entities = world.names_now().entities
            found = np.array([entities.get(name, NOBODY) for name in self.names], np.int64)
            self._there = world.slots.live(found)
            self._rows = np.full(len(found), NOBODY)
            self._rows[self._there] = world.slots.rows(found[self._there])
            self._every, self._some = np.array([self._there.all()]), np.array([self._there.any()])
            self.known.update(found[self._there].tolist())
            self._seen = (world.structure, world.restored)
        return self._rows

    def each(self, world: World) -> Booleans:
        """Tell of each whether it is there (n,)."""
        self.rows(world)
        return self._there

    def every(self, world: World) -> Booleans:
        """Tell whether all are there (1,)."""
        self.rows(world)
        return self._every

    def some(self, world: World) -> Booleans:
        """Tell whether anybody is there (1,)."""
        self.rows(world)
        return self._some

    def values(self, world: World, size: int, measure: Callable[[Integers], Floats]) -> Floats:
        """Return what ``measure`` says of rows (n, size), no number of who is not there."""
        rows, there = self.rows(world), self._there
        if self._every[0]:
            return measure(rows)
        values = np.full((len(rows), size), np.nan)
        if there.any():
            values[there] = measure(rows[there])
        return values

    def absence(self, world: World, index: int | None = None) -> str:
        """Say who of all, or whether one of them, is not there; nothing where nobody is missing."""
        there = self.each(world)
        missing = [number for number in np.nonzero(~there)[0].tolist() if index in (None, number)]
        if len(missing) == 1:
            name = self.names[missing[0]]
            return f"{name} {'has not come' if name in still_to_come(world) else 'is gone'}"
        told, more = [self.names[number] for number in missing[:MOST_TOLD]], len(missing) - MOST_TOLD
        return f"{', '.join(told)}{f' and {more} more' if more > 0 else ''} are not there" if missing else ""


def cast_of(patterns: Sequence[str], world: World) -> Cast:
    """Return whom names or patterns mean, each once; raise WordError for a name that nobody has or will have."""
    names = all_names(world)
    return Cast(dict.fromkeys(name for pattern in patterns for name in matching(pattern, names)), world)
