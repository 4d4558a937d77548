"""Commands: structural changes asked for inside a system, carried out between phases."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from carom.ecs.column import Booleans, Integers
from carom.ecs.component import Component, Resource
from carom.ecs.prefab import Prefab, merge
from carom.ecs.query import Query, as_handles

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
        groups = [as_handles(group) for group in entities]
        self.ask(lambda world: world.despawn(*(group[world.slots.live(group)] for group in groups)))

    def attach(self, entities: int | Integers | Query, *bundles: Component | Prefab) -> None:
        """Ask for components to be given to one entity, or to all of an array of handles or a query."""
        handles, parts = as_handles(entities), merge(bundles)

        def change(world: World) -> None:
            live = world.slots.live(handles)
            world.attach(handles[live], *(_of_those(live, part) for part in parts))

        self.ask(change)

    def detach(self, entities: int | Integers | Query, *kinds: type[Component]) -> None:
        """Ask for components to be taken from one entity, or from all of an array of handles or a query."""
        handles = as_handles(entities)
        self.ask(lambda world: world.detach(handles[world.slots.live(handles)], *kinds))

    def ask(self, change: Callable[[World], object]) -> None:
        """Ask for any change: a function of the world."""
        self.queue.append(change)


def _of_those(which: Booleans, part: Component) -> Component:
    """Return a bundle with the values of some of its entities; a value for all stays as it is."""
    each = {n: value[which] for n, value in vars(part).items() if value.shape == (len(which), *part.columns[n].shape)}
    return type(part)(**vars(part) | each)


def apply_commands(world: World) -> None:
    """Carry out and empty the queue."""
    commands = world.resources.get(Commands)
    if isinstance(commands, Commands) and commands.queue:
        queue, commands.queue = commands.queue, []
        for change in queue:
            change(world)
