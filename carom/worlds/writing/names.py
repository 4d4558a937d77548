"""Names: what a written file calls entities, those without a name too where another points to them."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs import World
from carom.ecs.components.name import NAME_LENGTH
from carom.ecs.entity import INDEX_MASK
from carom.worlds.values import ENTITY_NAME


class Callings:
    """What entities are called in a file.

    A name that no file takes, or none at all, is replaced where others point there: `state` then says what it was.
    """

    def __init__(self, world: World) -> None:
        self.world = world
        self.taken = set(world.names())
        self.given: dict[int, str] = {}

    def name(self, entity: int) -> str:
        """Return what an entity is called of itself, if a file can call it so."""
        name = self.world.name(entity) if self.world.slots.lives(entity) else ""
        return name if ENTITY_NAME.fullmatch(name) and len(name) <= NAME_LENGTH else self.given.get(entity, "")

    def of(self, entity: int) -> str:
        """Return what others call a living entity, which is given a name where it has none."""
        name = self.name(entity)
        if not name:
            name = f"entity_{entity & INDEX_MASK}"
            while name in self.taken:
                name += "_"
            self.taken.add(name)
            self.given[entity] = name
        return name

    def all_of(self, entities: Any) -> Any:
        """Return what a column of entities states, a name or lists of them; None where it holds any but the living."""
        handles = np.asarray(entities)
        if not self.world.slots.live(handles).all():
            return None
        if handles.ndim == 0:
            return self.of(int(handles))
        return [self.all_of(part) for part in handles]
