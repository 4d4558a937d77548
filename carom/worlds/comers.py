"""Comers: who is not there at the start and comes by an event, as far as can be told beforehand."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, Component, Name, Transform, World
from carom.systems.actions import Spawn
from carom.systems.events import Events
from carom.systems.settings import Settings

Comers = dict[str, Spawn]


def comers(world: World) -> Comers:
    """Return who comes by events, by name."""
    spawns = [event.action for event in world[Events].entries if isinstance(event.action, Spawn)]
    return {name: spawn for spawn in spawns for name in spawn.names or ()}


def still_to_come(world: World) -> set[str]:
    """Return the names of those whose event is still to happen."""
    dt, later = world[Settings].dt, set[str]()
    for event in world[Events].entries:
        if isinstance(event.action, Spawn) and event.frame(dt) > world.frame:
            later.update(event.action.names or ())
    return later


def all_names(world: World) -> list[str]:
    """Return the names of who is there, then those of who comes by events."""
    return list(dict.fromkeys([*world.names(), *comers(world)]))


def kinds_of(name: str, world: World, coming: Comers) -> list[type[Component]]:
    """Return the components that somebody has, or comes with."""
    entity = world.names_now().entities.get(name)
    if entity is None:
        return list(dict.fromkeys([Transform, Name, *map(type, coming[name].bundles)]))
    row = world.row(entity)
    return [kind for kind, table in world.tables.items() if issubclass(kind, Component) and table.present[row]]


def senses(name: str, world: World, coming: Comers) -> bool:
    """Tell whether somebody is a sensor."""
    entity = world.names_now().entities.get(name)
    if entity is not None:
        return bool(world[Collider].sensor[world.row(entity)])
    return any(isinstance(part, Collider) and np.any(vars(part).get("sensor", False)) for part in coming[name].bundles)
