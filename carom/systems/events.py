"""Events: what a world is to do at stated times."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import floor
from sys import maxsize
from typing import Any, NamedTuple

import numpy as np

from carom.ecs import World, system
from carom.ecs.commands import Commands
from carom.ecs.component import Record, Resource
from carom.ecs.components.name import NAME_LENGTH
from carom.ecs.errors import DeclarationError
from carom.systems.actions import ACTIONS, Action, Despawn, Release, Spawn
from carom.systems.assembly import bundles_of
from carom.systems.declared import read_words
from carom.systems.parameters import WordFault, number_fault
from carom.systems.pushes import Pushes, push
from carom.systems.settings import Settings

MOST_TIMES = 1000  # that an event is done: each step looks at all of them
MOST_BROUGHT = 1_000_000  # entities, by one event in all of its times
NAMES_ALONE = (Release.key, Despawn.key)  # actions that are stated as a list of names


class Event(NamedTuple):
    """An action at a time (s)."""

    at: float
    action: Action

    def repeated(self, every: float, times: int) -> list[Event]:
        """Return it and those that follow, so many in all, ``every`` so many seconds."""
        return [Event(self.at + number * every, self.action.again(number)) for number in range(times)]

    def frame(self, dt: float) -> int:
        """Return the frame whose step contains the time; a time between two steps is the start of the later one.

        Where no number says which, it is one that no world comes to.
        """
        return 1 + floor(min(self.at / dt * (1.0 + 1e-12) + 1e-9, maxsize))


class Events(Resource):
    """What happens when.

    ``due`` is what happens in this step and ``pushed`` its impulses, ``given`` those since it from outside;
    ``structure`` and ``edited`` tell what the world had seen before, and what events opened.
    """

    def __init__(self) -> None:
        self.entries: list[Event] = []
        self.due: list[Action] = []
        self.pushed: list[Pushes] = []
        self.given: list[Pushes] = []
        self.edited: set[type[Record]] = set()
        self.structure = -1


@system(reads=(Settings,), writes=(Events, Commands))
def carry_out_events(world: World, dt: float) -> None:
    """Ask for what is due in this step, which is done right after, in the order stated."""
    events = world[Events]
    events.pushed, events.given, events.structure = events.given, [], world.structure
    events.edited = set()
    events.due = [event.action for event in events.entries if event.frame(dt) == world.frame]
    if events.due:
        world[Commands].ask(_carry_out)


def _carry_out(world: World) -> None:
    """Do what is due; who is pushed wakes."""
    events, before = world[Events], set(world.edited)
    for action in events.due:
        pushes = action.pushes(world)
        if pushes is not None:
            push(world, pushes)
            events.pushed.append(pushes)
        action.change(world)
    events.edited = world.edited - before


def repetitions(event: Event, every: float | None, times: int | None, faults: list[WordFault]) -> list[Event]:
    """Return an event, or all of those that are stated to follow each other; what is wrong is added to ``faults``."""
    if every is None and times is None:
        return [event]
    if every is None or times is None:
        faults.append(WordFault(("every" if every is None else "times",), "is missing; every and times go together"))
        return []
    if wrong := number_fault({"unit": "s", "above": 0.0}, every):
        faults.append(WordFault(("every",), wrong))
    if not isinstance(times, int) or not 1 <= times <= MOST_TIMES:
        faults.append(WordFault(("times",), f"must be from 1 to {MOST_TIMES}", repr(times)))
    elif isinstance(event.action, Spawn):
        faults += faults_of_repeated(event.action, times)
    return [] if faults else event.repeated(every, times)


def faults_of_repeated(spawn: Spawn, times: int) -> Iterator[WordFault]:
    """Yield what is wrong with so many entities, and with their names."""
    if (count := times * len(spawn.positions)) > MOST_BROUGHT:
        yield WordFault(("times",), f"brings {count} entities, more than {MOST_BROUGHT}")
        return
    longest = max(spawn.again(times - 1).names or ("",), key=len)
    if len(longest) > NAME_LENGTH:
        yield WordFault(("times",), f"the name {longest!r} of who comes exceeds {NAME_LENGTH} characters")


def read_event(world: World, at: float, words: Mapping[str, Any], faults: list[WordFault]) -> Event | None:
    """Return the event that words such as ``{"release": ["pin"]}`` state; None where anything is wrong with them.

    Everything wrong is added to ``faults``. What it names need not be there yet.
    """
    if len(words) != 1 or not words.keys() <= ACTIONS.keys():
        faults.append(WordFault((), "must state one action", ", ".join(words) or "none", ", ".join(ACTIONS)))
        return None
    ((key, stated),) = words.items()
    if key == Spawn.key:
        action: Action | None = _spawned(world, stated, faults)
    elif isinstance(stated, str) and key in NAMES_ALONE:
        action = None
        faults.append(WordFault((key,), "must be a list of names", repr(stated), f"[{stated!r}]"))
    else:
        stated = {"entities": stated} if isinstance(stated, (list, tuple)) else stated
        action = read_words(ACTIONS[key], stated, (key,), faults)
    if wrong := number_fault({"unit": "s", "least": 0.0}, at):
        faults.append(WordFault(("at",), wrong))
    return None if action is None else Event(at, action)


def _spawned(world: World, words: Mapping[str, Any], faults: list[WordFault]) -> Spawn | None:
    """Return the action that brings an entity of these words; they are those of `add_entity`."""
    further = dict(words)
    name, transform = further.pop("name", None), further.get("transform", {})
    place = np.array(transform.get("position", (0.0, 0.0, 0.0)), np.float64).reshape(1, 3)
    try:
        return Spawn(place, None if name is None else (name,), tuple(bundles_of(world, **further)))
    except DeclarationError as fault:
        faults.append(WordFault((Spawn.key,), str(fault)))
        return None
