"""Lint: what a world says that it can hardly mean; such a world runs, and `carom check` tells."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import numpy as np

from carom.ecs import Collider, Motion, RigidBody
from carom.ecs.relations.contact import Contact
from carom.ecs.system import System
from carom.systems.compound import bodies_of, part_at
from carom.systems.detection.contacts import find_contacts
from carom.systems.events import Events
from carom.systems.simulation import Simulation
from carom.worlds.builder import LoadedWorld
from carom.worlds.errors import Path
from carom.worlds.source import Source
from carom.worlds.variables import EXPRESSION

SMALLEST, LARGEST = 1e-3, 1e3  # m: the engine is meant for 1 cm to 100 m
FASTEST = 1e3  # m/s
LIGHTEST, HEAVIEST = 0.5, 25_000.0  # kg/m3: below the thinnest foam, above osmium
OVERLAP = 0.01  # share of the smaller one's size that may be meant as touching
MOST_TOLD = 20  # of one kind, so that a thousand alike do not hide the rest
NAME = re.compile(r"[^\W\d]\w*")
NAMING = {"prefabs": ("prefab",), "materials": ("material",), "layers": ("layer", "collides_with", "layers")}


class _DetectedError(Exception):
    """Detection is through; the rest of the step is not wanted."""


def lint(loaded: LoadedWorld) -> list[str]:
    """Return warnings, each with its place in the file: of names, times, sizes, and bodies in each other.

    It runs detection once, so that the world is not to be stepped afterwards.
    """
    unused(loaded.source)
    late(loaded)
    for told in (doubtful(loaded.simulation), overlapping(loaded.simulation)):
        lines = list(told)
        for entity, what in lines[:MOST_TOLD]:
            loaded.source.warn(loaded.places[entity], what)
        if len(lines) > MOST_TOLD:
            loaded.source.warn((), f"{len(lines) - MOST_TOLD} more of that kind")
    return loaded.source.warnings


def unused(source: Source) -> None:
    """Tell the names that the file itself defines and nobody uses."""
    for path in unused_names(source):
        source.warn(path, "is used nowhere")


def late(loaded: LoadedWorld) -> None:
    """Tell what is to happen, or expected, after the run has ended."""
    dt, frames = loaded.simulation.settings.dt, loaded.run.frames
    stated = enumerate(loaded.document.get("events") or ())
    numbers = [number for number, words in stated for _ in range(words.get("times", 1))]
    events = zip(numbers, loaded.simulation.world[Events].entries, strict=True)
    after: list[Path] = [("events", number, "at") for number, event in events if event.frame(dt) > frames]
    after += [item.path for item in loaded.expectations if (getattr(item, "frame", None) or 0) > frames]
    for path in dict.fromkeys(after):
        loaded.source.warn(path, f"comes after the end of the run, {frames * dt:g} s")


def unused_names(source: Source) -> Iterator[tuple[str, str]]:
    """Yield section and name of prefabs, materials, layers and variables that the file defines and nobody uses.

    Those of included files are there for others as well.
    """
    words = list(_words("", source.data))
    expressions = [found for _, text in words for found in EXPRESSION.findall(text)]
    used = {"variables": {name for found in expressions for name in NAME.findall(found)}}
    for section, keys in NAMING.items():
        used[section] = {text for key, text in words if key in keys}
        if any(EXPRESSION.search(text) for text in used[section]):
            used[section] |= set(source.data.get(section) or ())  # who is meant is only known when it is computed
    used["layers"] |= {name for names in source.data.get("layers", {}).values() for name in names if names != "all"}
    for section, names in used.items():
        for name in source.data.get(section) or ():
            if name not in names and source.home((section, name))[0] is source:
                yield section, name


def _words(key: str, value: Any) -> Iterator[tuple[str, str]]:
    """Yield every text of the data with the key it stands under."""
    if isinstance(value, str):
        yield key, value
    elif isinstance(value, dict):
        for inner, item in value.items():
            yield from _words(inner, item)
    elif isinstance(value, list):
        for item in value:
            yield from _words(key, item)


def doubtful(simulation: Simulation) -> Iterator[tuple[int, str]]:
    """Yield bodies whose size, speed or density hardly anything has, as when a unit was mistaken."""
    world = simulation.world
    body, motion, collider = world[RigidBody], world[Motion], world[Collider]
    owners = bodies_of(world)[world.row_numbers(Collider)]
    for row in world.row_numbers(RigidBody, Motion).tolist():
        entity, name = int(world.entity(row)), _called(simulation, row)
        if not world.table(Collider).present[row]:
            continue  # a mass point, which may be a planet
        speed = float(np.linalg.norm(motion.linear[row]))
        if speed > FASTEST:
            yield entity, f"{name} moves at {speed:.3g} m/s; was another unit meant?"
        size = 2.0 * float(np.max(collider.bound_half[row]) + collider.bound_radius[row])
        if not SMALLEST <= size <= LARGEST:
            yield entity, f"{name} is {size:.3g} m long; was another unit meant?"
        volume = part_at(world, row, row).solid.volume if np.sum(owners == row) == 1 else 0.0
        density = float(body.mass[row]) / volume if volume else LIGHTEST
        if not LIGHTEST <= density <= HEAVIEST:
            yield entity, f"{name} has {density:.3g} kg/m3; is its mass or its size meant otherwise?"


def overlapping(simulation: Simulation) -> Iterator[tuple[int, str]]:
    """Yield pairs of which one moves and that are in each other at the start, deepest first."""
    world = simulation.world

    def stop(system: System) -> None:
        if system is find_contacts:
            raise _DetectedError

    with suppress(_DetectedError):
        simulation.schedule.run(world, simulation.settings.dt, after=stop)
    contact, collider = world[Contact], world[Collider]
    size = 2.0 * (collider.bound_half.max(axis=1) + collider.bound_radius)
    told: set[tuple[int, int]] = set()
    for index in np.argsort(-contact.depth[:], kind="stable"):
        a, b = int(contact.row_a[index]), int(contact.row_b[index])
        depth = float(contact.depth[index])
        if depth <= OVERLAP * min(size[a], size[b]) or (a, b) in told:
            continue
        told.add((a, b))
        names = f"{_called(simulation, a)} and {_called(simulation, b)}"
        yield int(world.entity(b)), f"{names} are {depth:.3g} m in each other at the start"


def _called(simulation: Simulation, row: Any) -> str:
    entity = simulation.world.entity(row)
    return simulation.world.name(entity) or f"entity {int(entity)}"
