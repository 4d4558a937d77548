"""Two colliders that touch."""

from __future__ import annotations

from typing import Any

from carom.systems.simulation import Simulation


def touching(first: dict[str, Any], second: dict[str, Any], collision: str = "auto") -> Simulation:
    """Return two balls that overlap by 1 cm, after one step, as these colliders or materials."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), collision=collision, response="reflect")
    simulation.layers({"red": ["red", "blue"], "blue": ["red"], "green": ["red", "green"], "deaf": []})
    for k, words in enumerate((first, second)):
        collider = {"sphere": {"radius": 0.5}, **words.get("collider", {})}
        place = {"position": (0.99 * k, 0.0, 0.0)}
        simulation.add(collider=collider, material=words.get("material"), body={"mass": 1.0}, transform=place)
    simulation.step()
    return simulation
