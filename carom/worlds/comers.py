"""Comers: who is not there at the start and comes by an event, as far as can be told beforehand."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, Component, Name, Transform, World
from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
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


def pose_of_comer(name: str, world: World) -> tuple[Floats, Floats] | None:
    """Return where somebody will come, position (3,), m, and rotation (4,); None of who is not to come."""
    if name not in still_to_come(world):
        return None
    spawn = comers(world)[name]
    number = (spawn.names or ()).index(name)
    turns = [
        vars(part)["rotation"] for part in spawn.bundles if "rotation" in vars(part) and isinstance(part, Transform)
    ]
    rotations = np.broadcast_to(turns[-1] if turns else quaternion.IDENTITY, (len(spawn.positions), 4))
    return spawn.positions[number], rotations[number]


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
