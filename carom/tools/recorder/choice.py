"""Choice: some of the entities of a world, by their names."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from carom.ecs import World
from carom.ecs.column import Booleans, Integers
from carom.systems.compound import bodies_of
from carom.worlds.names import fitting


class Choice:
    """Entities by patterns of names as world files have them: ``ball``, ``crate*``, ``rain`` for all of a grid.

    They are sought anew whenever somebody comes or goes. A body stands for all colliders that belong to it.
    """

    def __init__(self, patterns: Sequence[str]) -> None:
        self.patterns = tuple(patterns)
        self._structure = -1
        self._chosen: Booleans = np.zeros(0, np.bool_)

    def rows(self, world: World) -> Booleans:
        """Tell of each row in use whether it is chosen."""
        if self._structure != world.structure:
            names = world.names()
            found = {name for pattern in self.patterns for name in fitting(pattern, names)}
            self._chosen = np.zeros(world.used(), np.bool_)
            self._chosen[[world.row(world.find(name)) for name in found]] = True
            body = bodies_of(world)
            self._chosen |= (body >= 0) & self._chosen[body]
            self._structure = world.structure
        return self._chosen

    def has(self, world: World, entities: Integers) -> Booleans:
        """Tell of each handle (n,) whether it is chosen; one that lives no more is not."""
        live = np.asarray(world.slots.live(entities))
        found = np.zeros(len(entities), np.bool_)
        found[live] = self.rows(world)[world.slots.rows(entities[live])]
        return found
