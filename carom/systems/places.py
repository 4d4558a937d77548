"""Places: systems that are declared outside carom, put into the frame beside one that is there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

from carom.ecs.errors import DeclarationError
from carom.ecs.schedule import Schedule
from carom.ecs.system import System
from carom.systems.extensions import load_extensions, origin


@dataclass(frozen=True)
class Place:
    """A system and the one it runs right behind, or right in front of."""

    system: System
    neighbour: str
    behind: bool

    @property
    def module(self) -> str:
        """The module of the system."""
        return self.system.function.__module__

    def beside(self, other: System) -> tuple[System, ...]:
        """Return another system, and this one beside it where it is the neighbour."""
        if other.name != self.neighbour:
            return (other,)
        return (other, self.system) if self.behind else (self.system, other)

    def __str__(self) -> str:
        """Return the system with where it comes from."""
        return f"system '{self.system.name}' of {origin(self.module)}"


PLACES: dict[str, Place] = {}


def placed(*, after: str | None = None, before: str | None = None) -> Callable[[System], System]:
    """Give a system its place in the frame of every simulation, right after or right before the system of that name.

    Written above ``@system``. Systems of one module with the same neighbour run in the order they are written.
    """
    neighbour = after if after is not None else before
    if neighbour is None or (after is not None and before is not None):
        raise DeclarationError('a place is either after or before one system; write @placed(after="apply_gravity")')

    def enter(system: System) -> System:
        place = Place(system, neighbour, after is not None)
        known = PLACES.get(system.name)
        if known is not None and known.module != place.module:
            raise DeclarationError(
                f"two systems are named {system.name}: {known.module} and {place.module}; rename one of them"
            )
        PLACES[system.name] = place
        return system

    return enter


def extended(schedule: Schedule) -> Schedule:
    """Return a schedule with every placed system in it; raise DeclarationError for one that does not fit in."""
    load_extensions()
    return _with_places(schedule, tuple(PLACES.values())) if PLACES else schedule


@cache
def _with_places(schedule: Schedule, places: tuple[Place, ...]) -> Schedule:
    phases = schedule.phases
    waiting = sorted(places, key=lambda place: place.module)  # not in order of import, which differs from run to run
    for place in waiting:
        if any(place.system.name == system.name for _, system in schedule):
            raise DeclarationError(f"{place} is named like one of carom's; rename it")
    while waiting:
        names = [system.name for phase in phases for _, system in phase]
        ready = [place for place in waiting if place.neighbour in names]
        if not ready:
            side = "after" if waiting[0].behind else "before"
            there = ", ".join(names)
            raise DeclarationError(f"{waiting[0]} is placed {side} '{waiting[0].neighbour}'; there are {there}")
        for place in [p for p in ready if not p.behind] + [p for p in reversed(ready) if p.behind]:
            phases = tuple(phase.exchanged(place.beside) for phase in phases)
        waiting = [place for place in waiting if place not in ready]
    try:
        return Schedule(*phases)
    except DeclarationError as fault:
        raise DeclarationError("\n  ".join([str(fault), *(f"{place} is placed in it" for place in places)])) from None
