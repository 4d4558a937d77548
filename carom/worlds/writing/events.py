"""Events in words: those that are still to come."""

from __future__ import annotations

from collections.abc import Iterator

from carom.ecs import Transform, World
from carom.systems.actions import Action, Spawn
from carom.systems.events import Event, Events
from carom.systems.layers import Layers
from carom.systems.materials import Materials
from carom.systems.parameters import words_of
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries
from carom.systems.simulation import Simulation
from carom.worlds.names import fitting
from carom.worlds.writing.columns import Words, plain
from carom.worlds.writing.entities import EntityWriter
from carom.worlds.writing.models import Models
from carom.worlds.writing.names import Callings


def event_words(world: World, models: Models) -> list[Words]:
    """Return the events that are still to come, in their order; who comes in one crowd comes one after another."""
    dt, entries = world[Settings].dt, world[Events].entries
    later = [event for event in entries if event.frame(dt) > world.frame]
    names = [*world.names(), *(name for event in later for name in getattr(event.action, "names", None) or ())]
    return [words for event in later for words in _said(world, event, names, models)]


def _said(world: World, event: Event, names: list[str], models: Models) -> Iterator[Words]:
    action = event.action
    if isinstance(action, Spawn):
        yield from ({"at": event.at, action.key: words} for words in _spawned(world, action, models))
        return
    words = plain(words_of(action))
    if action.entities:
        words["entities"] = [pattern for pattern in action.entities if _means(world, action, pattern, names)]
    if not action.entities or words["entities"]:
        yield {"at": event.at, action.key: words["entities"] if words.keys() == {"entities"} else words}


def _means(world: World, action: Action, pattern: str, names: list[str]) -> bool:
    """Tell whether a pattern means anybody who is there or comes, and nobody to whom the action means nothing."""
    found = fitting(pattern, names)
    here = set(world.names())
    return bool(found) and not any(action.unfit(world, world.row(world.find(one))) for one in found if one in here)


def _spawned(world: World, action: Spawn, models: Models) -> list[Words]:
    """Return the words of who comes: those of a world that holds nobody else."""
    lone = Simulation(**vars(world[Settings])).world
    for kind in (Materials, Layers, Geometries):
        lone.add(world[kind])
    names = None if action.names is None else [*action.names]
    lone.spawn_many(len(action.positions), *action.bundles, Transform(position=action.positions), names=names)
    return EntityWriter(lone, Callings(lone), models).all()
