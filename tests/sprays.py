"""Sprays: worlds with an emitter, and where their particles are."""

from __future__ import annotations

from typing import Any

from carom.ecs.column import Floats
from carom.ecs.relations.particle import Particle
from carom.systems.simulation import Simulation


def emitting(
    *, floor: dict[str, Any] | None = None, dt: float = 1 / 240, height: float = 0.0, **words: Any
) -> Simulation:
    """Return a world with an emitter, 'source', and a floor where its material is stated."""
    simulation = Simulation(dt=dt)
    if floor is not None:
        simulation.add(collider={"plane": {}}, material=floor)
    material = {"restitution": 0.0, "friction": 0.0} if floor is None else floor
    simulation.add(name="source", emitter=words, material=material, transform={"position": (0.0, height, 0.0)})
    return simulation


def positions(simulation: Simulation) -> Floats:
    """Return where all particles are."""
    return simulation.world[Particle].position(slice(0, simulation.world.count(Particle)))


def velocities(simulation: Simulation) -> Floats:
    """Return how fast all particles are."""
    return simulation.world[Particle].velocity(slice(0, simulation.world.count(Particle)))
