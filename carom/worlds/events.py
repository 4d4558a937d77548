"""Events of a world file."""

from __future__ import annotations

from typing import Any

from carom.ecs.errors import DeclarationError
from carom.systems.actions import Action, Spawn
from carom.systems.events import Event, Events, read_event, repetitions
from carom.systems.parameters import WordFault
from carom.worlds.comers import all_names
from carom.worlds.crowd import Form, Member, put_together
from carom.worlds.errors import Path, WordError
from carom.worlds.groups import WORLD
from carom.worlds.intake import Intake
from carom.worlds.names import matching
from carom.worlds.prefab import Prefabs
from carom.worlds.source import Source
from carom.worlds.unfold import Item


def with_prefabs(prefabs: Prefabs, data: dict[str, Any]) -> dict[str, Any]:
    """Return the data of a world in which those who are spawned have the words of their prefabs."""
    events = data.get("events")
    if not isinstance(events, list):
        return data
    return data | {"events": [_with_prefab(prefabs, ("events", index), words) for index, words in enumerate(events)]}


def _with_prefab(prefabs: Prefabs, path: Path, words: Any) -> Any:
    if not (isinstance(words, dict) and Spawn.key in words):
        return words
    spawned, _ = prefabs.extended((*path, Spawn.key), words[Spawn.key])
    return words | {Spawn.key: spawned}


def add_events(source: Source, intake: Intake, events: list[Any]) -> None:
    """Let events of a file happen; report everything that is wrong with them. None stands for one already reported."""
    world, read = intake.simulation.world, list[tuple[Path, Action]]()
    for index, words in enumerate(events):
        if words is None:
            continue
        path: Path = ("events", index)
        stated = words.model_dump(exclude_unset=True)
        at, every, times = (stated.pop(word, None) for word in ("at", "every", "times"))
        faults = list[WordFault]()
        if stated.keys() == {Spawn.key}:
            spawned = _spawn(intake, (*path, Spawn.key), words.spawn)
            event = None if spawned is None else Event(at, spawned)
        else:
            event = read_event(world, at, stated, faults)
        following = [] if event is None else repetitions(event, every, times, faults)
        for fault in faults:
            source.report_value((*path, *fault.steps), fault)
        if event is not None:
            world[Events].entries += following
            read.append(((*path, event.action.key), event.action))
    for place, action in read:
        _check_names(source, intake, place, action)


def _spawn(intake: Intake, path: Path, words: Any) -> Spawn | None:
    """Return the action that brings who is stated; report what is wrong with the words."""
    some = intake.read(Item(path, words.name, words, WORLD), words.model_dump(exclude_unset=True))
    if some is None:
        return None
    try:
        places, names, bundles = put_together([Member(some, Form(intake.simulation.world, [some]), 0)])
    except DeclarationError as fault:
        intake.report(path, str(fault))
        return None
    return Spawn(places, None if names is None else tuple(names), tuple(bundles))


def _check_names(source: Source, intake: Intake, path: Path, action: Action) -> None:
    """Report names of nobody who is there or comes later, and of those to whom the action means nothing."""
    world = intake.simulation.world
    names, here = all_names(world), set(world.names())
    for number, pattern in enumerate(action.entities):
        place = (*path, number) if source.written((*path, number)) else (*path, "entities", number)
        try:
            found = matching(pattern, names)
        except WordError as fault:
            source.report_value(place, fault)
            continue
        for name in found:
            unfit = action.unfit(world, world.row(world.find(name))) if name in here else ""
            if unfit:
                source.report(place, unfit, received=repr(name))
