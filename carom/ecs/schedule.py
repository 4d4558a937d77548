"""Schedules: the frame as one literal, checked when it is built and printed as a table."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from carom.ecs.commands import apply_commands
from carom.ecs.component import Record
from carom.ecs.errors import DeclarationError
from carom.ecs.system import Kind, System

if TYPE_CHECKING:
    from carom.ecs.world import World

Repeat = Callable[["World"], int]
AfterSystem = Callable[[System], None]


class Phase:
    """Systems in order under one name, run ``repeat(world)`` times with the time step divided among the repeats."""

    def __init__(self, name: str, *systems: System, repeat: Repeat | None = None) -> None:
        self.name, self.systems, self.repeat = name, systems, repeat


class Schedule:
    """Phases in order; order of writing is order of execution."""

    def __init__(self, *phases: Phase) -> None:
        self.phases = phases
        self._check()

    def __iter__(self) -> Iterator[tuple[Phase, System]]:
        return ((phase, system) for phase in self.phases for system in phase.systems)

    def run(self, world: World, dt: float, *, checked: bool = False, after: AfterSystem | None = None) -> None:
        """Run one frame of ``dt`` seconds; ``checked`` enforces declared access, ``after`` hears of each system run."""
        with world.faces(None):
            for phase in self.phases:
                repeats = phase.repeat(world) if phase.repeat else 1
                share = dt / repeats
                for _ in range(repeats):
                    for system in phase.systems:
                        if checked:
                            system.guarded(world, share)
                        else:
                            system.function(world, share)
                        if after is not None:
                            after(system)
                apply_commands(world)

    def with_system(self, new: System, *, after: str) -> Schedule:
        """Return this schedule with ``new`` behind the system named ``after``."""
        names = [system.name for _, system in self]
        if after not in names:
            raise DeclarationError(f"no system is named {after!r}; there are {', '.join(names)}")
        phases = []
        for phase in self.phases:
            systems: list[System] = []
            for system in phase.systems:
                systems += [system, new] if system.name == after else [system]
            phases.append(Phase(phase.name, *systems, repeat=phase.repeat))
        return Schedule(*phases)

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
