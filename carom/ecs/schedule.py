"""Schedules: the frame as one literal, checked when it is built and printed as a table."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import chain
from typing import TYPE_CHECKING, Final

from carom.ecs.access import Kind
from carom.ecs.component import Record
from carom.ecs.errors import DeclarationError, did_you_mean
from carom.ecs.phase import AfterSystem, Frame, Phase
from carom.ecs.system import System
from carom.ecs.timings import COMMANDS, Timings

if TYPE_CHECKING:
    from carom.ecs.world import World


class Schedule:
    """Phases in order; order of writing is order of execution. A schedule never changes: `insert` makes another."""

    def __init__(self, *phases: Phase) -> None:
        self.phases: Final = phases
        self._names = (*(system.name for _, system in self), COMMANDS)
        self._check()

    def __iter__(self) -> Iterator[tuple[Phase, System]]:
        return chain(*self.phases)

    def run(self, world: World, dt: float, *, checked: bool = False, after: AfterSystem | None = None) -> None:
        """Run one frame of ``dt`` seconds; ``checked`` enforces declared access, ``after`` hears of each system run."""
        if Timings not in world.resources:
            world.add(Timings())
        timings = world.resources[Timings]
        assert isinstance(timings, Timings)
        try:
            with world.faces(None):
                Frame(world, checked, after, *timings.begin(self._names)).go_through(self.phases, dt)
        finally:
            world.running = None

    def insert(self, *new: System, before: str | None = None, after: str | None = None) -> Schedule:
        """Return this schedule with systems right before or right after the one of that name."""
        neighbour = before if after is None else after
        if neighbour is None or (before is not None and after is not None):
            raise DeclarationError(
                'a system is inserted either before or after another; write insert(my_system, after="apply_gravity")'
            )
        around = (lambda old: (old, *new)) if after is not None else (lambda old: (*new, old))
        phases = self._exchanged([neighbour], around)
        return _changed(phases, f"with {_listed(system.name for system in new)}")

    def replace(self, name: str, new: System) -> Schedule:
        """Return this schedule with another system in the place of the one of that name."""
        phases = self._exchanged([name], lambda old: (new,))
        return _changed(phases, f"with {new.name!r} in the place of {name!r}")

    def remove(self, *names: str) -> Schedule:
        """Return this schedule without the systems of these names."""
        return _changed(self._exchanged(names, lambda old: ()), f"without {_listed(names)}")

    def _exchanged(self, names: Iterable[str], exchange: Callable[[System], tuple[System, ...]]) -> list[Phase]:
        """Return the phases with each system of ``names`` exchanged for others."""
        there = self._names[:-1]
        for name in names:
            if name not in there:
                hints = " ".join(filter(None, [did_you_mean(name, there), f"there are {', '.join(there)}"]))
                raise DeclarationError(f"no system is named {name!r}; {hints}")
        return [phase.exchanged(lambda old: exchange(old) if old.name in names else (old,)) for phase in self.phases]

    def _check(self) -> None:
        faults: list[str] = []
        names: set[str] = set()
        written: set[Kind] = set()
        read: set[Kind] = set()
        for phase, system in self:
            where = f"system '{system.name}' in phase '{phase.name}'"
            if system.name in names:
                faults.append(f"{where} is placed twice; place it once")
            names.add(system.name)
            for kind in (*system.reads, *system.adds):
                if issubclass(kind, Record) and kind.derived() and kind not in written:
                    faults.append(
                        f"{where} needs {kind.__name__}, which neither files nor an earlier system supply; "
                        f"place a system that writes it before"
                    )
            read.update((*system.reads, *system.adds, *(kind for kind in system.writes if kind in written)))
            written.update(system.writes)  # to write is also to read what is there
        for kind in sorted(written - read, key=lambda k: k.__name__):
            if issubclass(kind, Record) and kind.derived() and not kind.kept:
                writers = ", ".join(s.name for _, s in self if kind in s.writes)
                faults.append(f"{kind.__name__} is written by {writers} and read by nobody; read it or remove it")
        if faults:
            raise DeclarationError("the schedule is wrong:\n  " + "\n  ".join(faults))


def _changed(phases: list[Phase], change: str) -> Schedule:
    try:
        return Schedule(*phases)
    except DeclarationError as fault:
        raise DeclarationError(f"{change} {fault}") from None


def _listed(names: Iterable[str]) -> str:
    return ", ".join(map(repr, names))
