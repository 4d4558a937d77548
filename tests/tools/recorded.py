"""Simulations that are recorded, and what they were in each frame."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from carom.ecs import Entity, Transform, Visual
from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.recorder import Recorder
from carom.tools.recording import Recording

RED, BLUE, GREY = (0.9, 0.1, 0.1), (0.1, 0.2, 0.9), (0.4, 0.4, 0.4)


def falling_world() -> Simulation:
    """Return balls of two colours, a capsule and a box with an offset shape above a floor."""
    simulation = Simulation(dt=1 / 240)
    simulation.add(name="floor", collider={"plane": {}}, material={"color": GREY})
    for k in range(6):
        color = RED if k % 2 else BLUE
        ball(simulation, f"ball[{k}]", (0.3 * k, 0.3 + 0.1 * k, 0.0), color)
    simulation.add(
        name="capsule",
        transform={"position": (0.0, 0.5, 1.0)},
        motion={"angular": (1.0, 2.0, 3.0)},
        collider={"capsule": {"radius": 0.05, "length": 0.2}},
        body={},
    )
    simulation.add(
        name="hammer",
        transform={"position": (1.0, 0.5, 1.0), "rotation": (0.0, 0.0, 0.6, 0.8)},
        collider={"box": {"size": (0.1, 0.2, 0.3)}, "position": (0.0, 0.4, 0.0)},
        body={},
    )
    return simulation


def ball(simulation: Simulation, name: str, position: tuple[float, float, float], color: Any = RED) -> Entity:
    """Add a ball of 10 cm."""
    return simulation.add(
        name=name,
        transform={"position": position},
        collider={"sphere": {"radius": 0.05}},
        body={},
        material={"color": color, "restitution": 0.5},
    )


def poses(simulation: Simulation) -> dict[int, tuple[Any, Any]]:
    """Return the pose of every visible entity as a recording must hold it."""
    world = simulation.world
    rows = world.row_numbers(Visual, Transform)
    rows = rows[world[Visual].visible[rows]]
    transform = world[Transform]
    return {
        int(entity): (transform.position[row].astype(np.float32), transform.rotation[row].astype(np.float32))
        for entity, row in zip(world.entities(rows), rows, strict=True)
    }


def assert_same_poses(recording: Recording, frame: int, expected: dict[int, tuple[Any, Any]]) -> None:
    """Compare one frame bit by bit."""
    received = recording.poses(frame)
    assert received.keys() == expected.keys()
    for entity, (position, rotation) in expected.items():
        assert np.array_equal(received[entity].position, position)
        assert np.array_equal(received[entity].rotation, rotation)


def record(simulation: Simulation, path: Path, frames: int, **options: Any) -> dict[int, dict[int, tuple[Any, Any]]]:
    """Run with a recorder; return the poses of every step."""
    seen = {0: poses(simulation)}
    with observed(simulation, Recorder(path, **options)):
        for _ in range(frames):
            simulation.step()
            seen[simulation.frame] = poses(simulation)
    return seen
