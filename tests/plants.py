"""Plants: bugs that tests put into one system of one world, called ``planted``, and into no other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from carom.ecs import World
from carom.systems.simulation import Simulation
from carom.tools import replay
from carom.worlds import LoadedWorld, builder

Spoil = Callable[[World, float], None]


def spoil_system(simulation: Simulation, name: str, *, before: Spoil | None = None, after: Spoil | None = None) -> None:
    """Let something wrong be done right before or right after what a system does, in its name."""
    sound = next(system for _, system in simulation.schedule if system.name == name)

    def spoiled(world: World, dt: float) -> None:
        if before:
            before(world, dt)
        sound(world, dt)
        if after:
            after(world, dt)

    spoiled.__name__, spoiled.__doc__ = name, sound.function.__doc__
    simulation.schedule = simulation.schedule.replace(name, replace(sound, function=spoiled))


def plant(monkeypatch: pytest.MonkeyPatch, spoil: Callable[[Simulation], None]) -> None:
    """Spoil every world of the name ``planted`` as it is loaded, from a file or from a recording."""
    load = builder.load_text

    def loads(*words: Any, **options: Any) -> LoadedWorld:
        loaded = load(*words, **options)
        if loaded.name == "planted":
            spoil(loaded.simulation)
        return loaded

    monkeypatch.setattr(builder, "load_text", loads)
    monkeypatch.setattr(replay, "load_text", loads)
