"""Commands: structural changes asked for inside a system, carried out between phases."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from carom.ecs.component import Resource

if TYPE_CHECKING:
    from carom.ecs.world import World


class Commands(Resource):
    """The queue of a world; systems append, the schedule applies after each phase in the order asked."""

    def __init__(self) -> None:
        self.queue: list[Callable[[World], object]] = []

    def ask(self, change: Callable[[World], object]) -> None:
        """Queue a change such as ``lambda world: world.despawn(entity)``."""
        self.queue.append(change)


def apply_commands(world: World) -> None:
    """Carry out and empty the queue."""
    commands = world.resources.get(Commands)
    if isinstance(commands, Commands) and commands.queue:
        queue, commands.queue = commands.queue, []
        for change in queue:
            change(world)
