"""Who sleeps and who is fast: what they cost, and that bullets do not pass."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from carom.systems.simulation import Simulation
from carom.tools.bench.measure import Figure, figure, timed

PILE, HIGH, APART = 10_000, 4, 1.5  # m between stacks of cubes of 1 m
STEPS, PHASES = 301, 20
CUBE = {"box": {"size": (1.0, 1.0, 1.0)}}
BULLETS = {
    "ball": {"sphere": {"radius": 0.005}},
    "tumbling cube": {"box": {"size": (0.01, 0.01, 0.01)}},
    "tumbling capsule": {"capsule": {"radius": 0.005, "length": 0.01}},
}


def sleep() -> Iterator[Figure]:
    """Time a step of stacks that have fallen asleep, and of them and a ball that falls beside."""
    simulation = Simulation(checked=False)
    simulation.add(collider={"plane": {}})
    side = np.arange(int(np.sqrt(PILE / HIGH))) * APART
    x, z, y = np.meshgrid(side, side, np.arange(HIGH) + 0.5, indexing="ij")
    simulation.add_many(np.stack([x, y, z], axis=-1).reshape(-1, 3), collider=CUBE, body={}, visual=False)
    simulation.step(60)
    yield figure(f"step of {PILE:,} that sleep", "ms", timed(simulation.step, STEPS), 0.2, 1e3)
    place = {"position": (-50.0, 1e4, 0.0)}
    simulation.add(collider={"sphere": {"radius": 0.5}}, body={}, transform=place, visual=False)
    simulation.step()
    yield figure("the same and one that is awake", "ms", timed(simulation.step, 101), np.inf, 1e3)


def fast() -> Iterator[Figure]:
    """Count the bullets of 1 cm that a wall of 2 cm stops at 300 m/s, wherever in a step they come there."""
    for name, collider in BULLETS.items():
        stopped = sum(is_stopped(collider, phase / PHASES, tumbling=name != "ball") for phase in range(PHASES))
        yield Figure(f"stopped of {PHASES}, {name}", "bullets", stopped, stopped, PHASES, "value", at_least=True)


def is_stopped(collider: object, phase: float, *, tumbling: bool) -> bool:
    """Tell whether a bullet that begins ``phase`` of a step farther away is on its side of the wall after six steps."""
    simulation, speed = Simulation(gravity=(0.0, 0.0, 0.0), checked=False), 300.0
    simulation.add(collider={"box": {"size": (0.02, 2.0, 2.0)}})
    place = {"position": (-3.0 - phase * speed * simulation.settings.dt, 0.03, 0.02)}
    flies = {"linear": (speed, 0.0, 0.0), "angular": (3.0, 40.0, 25.0) if tumbling else (0.0, 0.0, 0.0)}
    bullet = simulation.add(collider=collider, body={"mass": 0.01}, transform=place, motion=flies)
    simulation.step(6)
    return bool(simulation[bullet].transform.position[0] < 0.0)
