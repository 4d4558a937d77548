"""Stacks that fall asleep, for tests of sleeping."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from carom.ecs import Motion
from carom.systems.awake import Awake
from carom.systems.simulation import Simulation

BOX = {"box": {"size": (1.0, 1.0, 1.0)}}
BALL = {"sphere": {"radius": 0.5}}
FLOOR = {"box": {"size": (20.0, 1.0, 20.0)}}


def stacks(*places: float, high: int = 3, **settings: Any) -> Simulation:
    """Return stacks of cubes at places along x, on a floor: first of a0, a1 and so on, then of b0."""
    simulation = Simulation(**settings)
    simulation.add(name="floor", collider=FLOOR, transform={"position": (0.0, -0.5, 0.0)})
    for letter, x in zip("abc", places, strict=False):
        for k in range(high):
            simulation.add(
                name=f"{letter}{k}", collider=BOX, body={"mass": 1.0}, transform={"position": (x, 0.5 + k, 0)}
            )
    return simulation


def asleep(simulation: Simulation, *names: str) -> list[bool]:
    """Return who sleeps."""
    world = simulation.world
    return [bool(world[Motion].asleep[world.row(world.find(name))]) for name in names]


def sleeping(*places: float, **settings: Any) -> Simulation:
    """Return stacks that have fallen asleep."""
    simulation = stacks(*places, **settings)
    simulation.step(90)
    assert len(simulation.world[Awake].rows) == 0
    return simulation


def choose(simulation: Simulation, **settings: Any) -> None:
    """Let a world go on by other settings."""
    simulation.settings = replace(simulation.settings, **settings)
