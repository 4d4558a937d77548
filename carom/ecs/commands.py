"""Commands: structural changes asked for inside a system, carried out between phases."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from carom.ecs.column import Integers
from carom.ecs.component import Component, Resource
from carom.ecs.prefab import Prefab
from carom.ecs.query import Query

if TYPE_CHECKING:
    from carom.ecs.world import World


class Commands(Resource):
    """The queue of a world; systems ask, the schedule carries out after each phase in the order asked.

    To ask for what another command of the same phase has made pointless, like a second `despawn`, is no fault.
    """

    def __init__(self) -> None:
        self.queue: list[Callable[[World], object]] = []

    def spawn(self, *bundles: Component | Prefab, name: str | None = None) -> None:
        """Ask for one entity, as `World.spawn` makes it."""
        self.ask(lambda world: world.spawn(*bundles, name=name))

    def spawn_many(self, count: int, *bundles: Component | Prefab, names: list[str] | None = None) -> None:
        """Ask for many entities, as `World.spawn_many` makes them."""
        self.ask(lambda world: world.spawn_many(count, *bundles, names=names))

    def despawn(self, *entities: int | Integers | Query) -> None:
        """Ask for entities, one by one, as arrays of handles or as queries, to be removed with those they carry."""
        groups = [group.entities if isinstance(group, Query) else np.atleast_1d(group) for group in entities]
        self.ask(lambda world: world.despawn(*(group[world.slots.live(group)] for group in groups)))

    def attach(self, entity: int, *bundles: Component | Prefab) -> None:
        """Ask for components to be given to an entity."""
        self.ask(lambda world: world.attach(entity, *bundles) if entity in world else None)

    def detach(self, entity: int, *kinds: type[Component]) -> None:
        """Ask for components to be taken from an entity."""
        self.ask(lambda world: world.detach(entity, *kinds) if entity in world else None)

    def ask(self, change: Callable[[World], object]) -> None:
        """Ask for any change: a function of the world."""
        self.queue.append(change)


def apply_commands(world: World) -> None:
    """Carry out and empty the queue."""
    commands = world.resources.get(Commands)
    if isinstance(commands, Commands) and commands.queue:
        queue, commands.queue = commands.queue, []
        for change in queue:
            change(world)
