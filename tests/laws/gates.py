"""Bodies that fly into sensors, and what the tables tell of them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs.relations.enter import Enter, Exit
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation

BALL = {"sphere": {"radius": 0.1}}
GATE = {"box": {"size": (1.0, 1.0, 1.0)}, "sensor": True}
CUBE = hull_of(np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]))
Event = tuple[str, float, int, int]


def events(simulation: Simulation, steps: int) -> list[Event]:
    """Return (what, time, sensor, entity) of all that sensors tell in the next steps, in order of their tables."""
    found: list[Event] = []
    for _ in range(steps):
        simulation.step()
        for kind in (Enter, Exit):
            table = simulation.world[kind]
            for row in range(table.count):
                told = float(table.time[row]), int(table.sensor[row]), int(table.entity[row])
                found.append((kind.key, *told))
    return found


def times(simulation: Simulation, steps: int) -> list[tuple[str, float]]:
    """Return (what, time) of the same."""
    return [event[:2] for event in events(simulation, steps)]


def near(what: str, time: float, within: float = 1e-9) -> tuple[str, Any]:
    """Return an event to compare with."""
    return what, pytest.approx(time, abs=within)


def flying(collider: dict[str, Any], position: Any, velocity: Any, **words: Any) -> tuple[Simulation, int]:
    """Return a world without gravity in which a body flies."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), **words)
    body = simulation.add(
        collider=collider, body={"mass": 1.0}, transform={"position": position}, motion={"linear": velocity}
    )
    return simulation, body


KINDS: dict[str, dict[str, Any]] = {
    "sphere": {"sphere": {"radius": 0.5}},
    "box": {"box": {"size": (1.0, 1.0, 1.0)}},
    "capsule": {"capsule": {"radius": 0.5, "length": 1.0}},
    "cylinder": {"cylinder": {"radius": 0.5, "length": 1.0}},
    "cone": {"cone": {"radius": 0.5, "length": 1.0}},
    "ellipsoid": {"ellipsoid": {"radii": (0.5, 0.7, 0.6)}},
    "convex": {"convex": {"points": CUBE.vertices}},
    "mesh": {"shape": Mesh(CUBE)},
    "point": {"point": {}},
}
