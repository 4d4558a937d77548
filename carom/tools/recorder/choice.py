"""Choice: some of the entities of a world, by their names or by what they have."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from carom.ecs import World
from carom.ecs.column import Booleans, Integers
from carom.ecs.query import Query
from carom.systems.compound import bodies_of
from carom.worlds.names import fitting

Chosen = Sequence[str] | Query


class Choice:
    """Entities by patterns of names as world files have them: ``ball``, ``crate*``, ``rain`` for all of a grid.

    Or those of a query, such as ``world.query(Enemy, without=Static)``. They are sought anew whenever somebody comes or
    goes. A body stands for all colliders that belong to it.
    """

    def __init__(self, chosen: Chosen) -> None:
        self.chosen = chosen if isinstance(chosen, Query) else tuple(chosen)
        self._structure = -1
        self._chosen: Booleans = np.zeros(0, np.bool_)

    @property
    def nobody(self) -> bool:
        """Whether nobody ever is chosen."""
        return self.chosen == ()

    @property
    def words(self) -> list[str]:
        """The patterns, or what a query asks for."""
        if not isinstance(self.chosen, Query):
            return list(self.chosen)
        parts = {"": self.chosen.kinds, "without ": self.chosen.without, "or ": self.chosen.any_of}
        return [f"{word}{kind.__name__}" for word, kinds in parts.items() for kind in kinds]

    def rows(self, world: World) -> Booleans:
        """Tell of each row in use whether it is chosen."""
        if self._structure != world.structure:
            self._chosen = np.zeros(world.used(), np.bool_)
            self._chosen[self._found(world)] = True
            body = bodies_of(world)
            self._chosen |= (body >= 0) & self._chosen[body]
            self._structure = world.structure
        return self._chosen

    def _found(self, world: World) -> Integers | list[int]:
        if isinstance(self.chosen, Query):
            return self.chosen.numbers
        names = world.names()
        found = {name for pattern in self.chosen for name in fitting(pattern, names)}
        return [world.row(world.find(name)) for name in found]

    def has(self, world: World, entities: Integers) -> Booleans:
        """Tell of each handle (n,) whether it is chosen; one that lives no more is not."""
        live = np.asarray(world.slots.live(entities))
        found = np.zeros(len(entities), np.bool_)
        found[live] = self.rows(world)[world.slots.rows(entities[live])]
        return found
