"""Worlds in which much touches at any time."""

from __future__ import annotations

from typing import Any

from carom.ecs import state_hash
from carom.systems.simulation import Simulation


def bin_of_balls(count: int, **settings: Any) -> Simulation:
    """Return balls thrown into a bin where they rattle: thousands of impacts in a step."""
    simulation = Simulation(dt=1 / 120, **settings)
    simulation.add(collider={"plane": {}}, name="floor")
    for x, z in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        wall = {"box": {"size": (0.2 if x else 2.4, 4.0, 0.2 if z else 2.4)}}
        simulation.add(collider=wall, transform={"position": (0.77 * x, 2.0, 0.77 * z)})
    for k in range(count):
        place = (-0.42 + 0.33 * (k % 3) + 0.01 * (k % 7), 0.2 + 0.34 * (k // 9), -0.4 + 0.32 * (k // 3 % 3))
        simulation.add(
            collider={"sphere": {"radius": 0.15}},
            body={"mass": 1.0},
            material={"restitution": 0.6 if k % 2 else 0.2},
            transform={"position": (place[0], place[1], place[2] + 0.005 * (k % 5))},
            motion={"linear": (0.3 * (k % 5 - 2), -3.0, 0.2 * (k % 3 - 1))},
            name=f"ball{k}",
        )
    return simulation


def stack_of_boxes(**settings: Any) -> Simulation:
    """Return boxes that fall onto each other and come to rest."""
    simulation = Simulation(dt=1 / 60, **settings)
    simulation.add(collider={"plane": {}}, name="floor")
    for k in range(4):
        place = {"position": (0.1 * k, 0.55 + 1.1 * k, 0.05 * k)}
        simulation.add(collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={}, transform=place, name=f"box{k}")
    return simulation


def hashes(simulation: Simulation, frames: int) -> list[str]:
    """Return the state hash after each of the next frames."""
    found = []
    for _ in range(frames):
        simulation.step()
        found.append(state_hash(simulation.world))
    return found
