"""What expectations can ask of the particles of an emitter: ``jet.particles.count``, ``jet.particles.upper.y``."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from carom.ecs import World
from carom.ecs.column import Floats
from carom.ecs.errors import did_you_mean
from carom.ecs.relations.particle import Particle
from carom.systems.particles.pieces import piece_of
from carom.worlds.errors import WordError

WORD = "particles"
AXES = ("x", "y", "z")
NOWHERE: Floats = np.full(3, np.nan)  # which is no value that anything expects
Measure = Callable[[Floats, Floats], Floats]  # of places and velocities (n, 3)
MEASURES: dict[str, tuple[str, int, Measure]] = {  # unit, size, and how it is found
    "count": ("1", 1, lambda place, velocity: np.array([float(len(place))])),
    "center": ("m", 3, lambda place, velocity: place.mean(axis=0)),
    "lower": ("m", 3, lambda place, velocity: place.min(axis=0)),
    "upper": ("m", 3, lambda place, velocity: place.max(axis=0)),
    "velocity": ("m/s", 3, lambda place, velocity: velocity.mean(axis=0)),
    "speed": ("m/s", 1, lambda place, velocity: np.sqrt((velocity**2).sum(axis=1)).mean(keepdims=True)),
}


def particle_measure(text: str, steps: list[str]) -> tuple[str, int, Callable[[World, int], Floats]]:
    """Return unit, size and reading of what stands behind ``particles.``, a measure and maybe an axis."""
    name, *axis = steps
    if name not in MEASURES:
        accepted, hint = ", ".join(MEASURES), did_you_mean(name, MEASURES)
        raise WordError(f"particles have no {name}", received=repr(text), accepted=accepted, hint=hint)
    unit, size, measure = MEASURES[name]
    if len(axis) > 1 or (axis and (size == 1 or axis[0] not in AXES)):
        accepted = "" if size == 1 else ", ".join(AXES)
        raise WordError(f"{name} has no {'.'.join(axis)}", received=repr(text), accepted=accepted)

    def read(world: World, entity: int) -> Floats:
        rows, particle = piece_of(world, entity).rows, world[Particle]
        place, velocity = particle.position(rows), particle.velocity(rows)
        found = measure(place, velocity) if len(place) or name == "count" else NOWHERE[:size]
        return found[AXES.index(axis[0])][None] if axis else found

    return unit, 1 if axis else size, read
