"""Divergence: two simulations side by side, and the system after which they are no longer the same."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from carom.ecs import Difference, Snapshot, System, first_difference, restore_snapshot, state_hash, take_snapshot
from carom.ecs.component import Relation
from carom.ecs.snapshot import copied, look_at
from carom.ecs.snapshot_faults import SAVED
from carom.systems.observer import unobserved
from carom.systems.simulation import Simulation

COMPARED = (*SAVED, "derived")  # a force differs before a velocity does


class Run(NamedTuple):
    """A system's ``number``-th run in a frame, counted from 1."""

    phase: str
    system: str
    number: int


START = Run("", "", 0)
OUTSIDE = "outside"  # the phase of what code outside the step does before it


def first_divergence(
    a: Simulation, b: Simulation, steps: int, outside: Callable[[], bool] | None = None
) -> Difference | None:
    """Step two simulations side by side until their worlds differ; return where that began, None if nowhere.

    Before each step ``outside`` does what code outside did then, and tells whether that was anything; where worlds
    differ right after it, no system is named.

    The frame is then run once more from its start, unseen by observers, to name the system after which they first
    differ, derived columns included, and what it wrote; both simulations are left at the end of that frame. What
    commands do between phases is told of the system that runs next, and no system is named where running the frame
    again leads elsewhere than the first time, as with a Python force that counts its calls.
    """
    found = first_difference(a.world, b.world)
    before: tuple[Snapshot | None, Snapshot | None] = (None, None)
    while found is None and steps > 0:
        if outside is not None and outside() and (found := first_difference(a.world, b.world)) is not None:
            return replace(found, phase=OUTSIDE)
        before = (take_snapshot(a.world, reuse=before[0]), take_snapshot(b.world, reuse=before[1]))
        for simulation in (a, b):
            simulation.step()
        found = first_difference(a.world, b.world)
        steps -= 1
    if found is None or before[0] is None or before[1] is None:
        return found
    return _born(a, b, before[0], before[1]) or found


def _born(a: Simulation, b: Simulation, before_a: Snapshot, before_b: Snapshot) -> Difference | None:
    traces = (_trace(a, before_a), _trace(b, before_b))
    runs = ([run for run, _ in traces[0]], [run for run, _ in traces[1]])
    for i, j, run in _side_by_side(*runs):
        if traces[0][i][1] != traces[1][j][1]:
            found = first_difference(_state_after(a, before_a, i), _state_after(b, before_b, j))
            return found and replace(found, system=run.system, phase=run.phase, run=run.number)
    return None


def _side_by_side(first: list[Run], second: list[Run]) -> Iterator[tuple[int, int, Run]]:
    """Yield how far each frame has come after every run; where one has a system the other lacks, that waits."""
    i = j = 0
    while i < len(first) - 1 or j < len(second) - 1:
        x = first[i + 1] if i < len(first) - 1 else None
        y = second[j + 1] if j < len(second) - 1 else None
        if x == y:
            i, j = i + 1, j + 1
        elif y is None or (x is not None and (x not in second or y in first)):
            i += 1
        else:
            j += 1
        yield i, j, x if x is not None and first[i] == x else second[j]


def _trace(simulation: Simulation, before: Snapshot) -> list[tuple[Run, str]]:
    """Run a frame; return a hash of everything compared at its start and after every run of a system."""
    phases = {system.name: phase.name for phase, system in simulation.schedule}
    runs: Counter[str] = Counter()
    trace: list[tuple[Run, str]] = []

    def note(system: System) -> None:
        runs[system.name] += 1
        run = Run(phases[system.name], system.name, runs[system.name])
        trace.append((run, state_hash(simulation.world, COMPARED)))

    _start(simulation, before)
    trace.append((START, state_hash(simulation.world, COMPARED)))
    with unobserved(simulation):
        simulation.step(after=note)
    return trace


def _state_after(simulation: Simulation, before: Snapshot, place: int) -> Snapshot:
    """Run a frame; return everything compared as it was after ``place`` runs of systems."""
    _start(simulation, before)
    state = copied(look_at(simulation.world, COMPARED))
    done = 0

    def note(system: System) -> None:
        nonlocal state, done
        done += 1
        if done == place:
            state = copied(look_at(simulation.world, COMPARED))

    with unobserved(simulation):
        simulation.step(after=note)
    return state


def _start(simulation: Simulation, before: Snapshot) -> None:
    """Go back to the start of a frame, with nothing in derived columns that frames before have left there."""
    world = simulation.world
    restore_snapshot(world, before)
    for kind, table in world.tables.items():
        if issubclass(kind, Relation):
            for array in table.arrays.values():
                array[world.count(kind) :] = np.zeros((), array.dtype)
