"""A breakpoint stops a simulation before the step that meets it is committed; a NaN names where it came from."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from heaps import stack_of_boxes

from carom.ecs import ExternalForce, Motion, NonFiniteError, World, state_hash
from carom.ecs.relations.contact import Contact
from carom.systems.breakpoints import Met, StoppedError, tried
from carom.systems.ring import Ring
from carom.systems.simulation import Simulation
from carom.worlds.breaks import break_when


class InFrame:
    """A breakpoint at one frame."""

    text = "in that frame"

    def __init__(self, frame: int) -> None:
        self.frame = frame

    def met(self, world: World) -> Met | None:
        """Look at the frame."""
        return Met("it is", (world.find("box0"),)) if world.frame == self.frame else None


class Seen:
    """An observer that keeps the hash of every frame."""

    def __init__(self) -> None:
        self.hashes: dict[int, str] = {}

    def begin(self, simulation: Simulation) -> None:
        """Do nothing."""

    def observe(self, simulation: Simulation) -> None:
        """Keep the hash."""
        self.hashes[simulation.frame] = state_hash(simulation.world)

    end = begin


def test_the_world_stands_before_the_step_and_that_step_can_be_looked_at() -> None:
    """Observers have seen it; rewound and taken again it is the same, and without the breakpoint all goes on."""
    free, simulation, seen = stack_of_boxes(), stack_of_boxes(), Seen()
    hashes = [state_hash(free.world)]
    for _ in range(12):
        free.step()
        hashes.append(state_hash(free.world))
    ring = Ring(9, 3)
    ring.begin(simulation)
    simulation.observers += [ring, seen]
    simulation.breakpoints.append(InFrame(8))
    for back in (0, 5, 1):
        ring.rewind(simulation, back)
        with pytest.raises(StoppedError) as stop:
            simulation.step(100)
        assert str(stop.value) == (
            "frame 8 at 0.133333 s: in that frame: it is; the world stands at frame 7, before that step"
        )
        assert stop.value.names == ["box0"]
        assert (simulation.frame, state_hash(simulation.world)) == (7, hashes[7])
        with tried(simulation):
            assert (simulation.frame, state_hash(simulation.world)) == (8, hashes[8])
        assert (simulation.frame, state_hash(simulation.world)) == (7, hashes[7])
    simulation.breakpoints.remove(stop.value.breakpoint)
    simulation.step(5)
    assert seen.hashes == {frame: hashes[frame] for frame in range(1, 13)}


def test_the_step_that_was_broken_off_is_shown_by_a_ring() -> None:
    """As its last frame, whether it is one of those that are kept or not."""
    for every in (1, 5):
        simulation, seen = stack_of_boxes(), Seen()
        ring = Ring(9, every)
        ring.begin(simulation)
        simulation.observers.append(ring)
        simulation.breakpoints.append(InFrame(8))
        with pytest.raises(StoppedError):
            simulation.step(100)
        seen.begin = seen.observe  # type: ignore[method-assign]
        ring.show(simulation, seen)
        assert list(seen.hashes) == list(range(9))
        assert simulation.frame == 7


def poisoned(what: str) -> Callable[[Simulation], None]:
    """Return what lets a number of the thirtieth frame be none."""

    def force(simulation: Simulation) -> None:
        def push(world: World, rows: Any) -> Any:
            return np.full((len(rows), 3), math.nan if world.frame == 30 else 0.0)

        simulation.force_function(push, "gust")

    def outside(simulation: Simulation) -> None:
        simulation.step(29)
        with simulation.world.edit(ExternalForce) as external:
            external.force[simulation.world.row(simulation.world.find("box1")), 1] = math.nan

    def system_of(name: str, spoil: Callable[[World], None]) -> Callable[[Simulation], None]:
        def replace(simulation: Simulation) -> None:
            system = next(system for _, system in simulation.schedule if system.name == name)

            def bad(world: World, dt: float) -> None:
                system(world, dt)
                if world.frame == 30:
                    spoil(world)

            bad.__name__ = name
            simulation.schedule = simulation.schedule.replace(name, dataclasses.replace(system, function=bad))

        return replace

    def spoil_normals(value: float) -> Callable[[World], None]:
        def spoil(world: World) -> None:
            world[Contact].normal[0] = value

        return spoil

    def spoil_speed(world: World) -> None:
        world[Motion].linear[world.row(world.find("box0"))] = math.inf

    return {
        "force": force,
        "outside": outside,
        "normal": system_of("find_contacts", spoil_normals(math.nan)),
        "velocity": system_of("hold", spoil_speed),
    }[what]


BY_HOLD = "written by system 'hold', by its contact with floor, box1"


@pytest.mark.parametrize(
    ("what", "message"),
    [
        ("force", "Force.force of entity 'box0' is [nan, nan, nan], written by system 'gust'"),
        ("outside", "ExternalForce.force of entity 'box1' is [0.0, nan, 0.0], set by code outside the step"),
        ("normal", "Contact.normal of entity 'floor and box0' is [nan, nan, nan], written by system 'find_contacts'"),
        (
            "velocity",
            f"Motion.linear of entity 'box0' is {[math.inf] * 3}, {BY_HOLD}",
        ),
    ],
)
def test_a_nan_names_system_entity_column_and_where_it_came_from(what: str, message: str) -> None:
    """The world stands before the step that made it."""
    simulation = stack_of_boxes()
    break_when(simulation, "not finite")
    poisoned(what)(simulation)
    with np.errstate(all="ignore"), pytest.raises(NonFiniteError) as fault:
        simulation.step(30)
    assert str(fault.value) == f"frame 30: {message}"
    assert simulation.frame == 29
    assert np.isfinite(simulation.world[Motion].linear).all()
