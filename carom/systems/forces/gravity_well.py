"""Gravity well: a mass that stands where it is and attracts everybody."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from carom.ecs import Force, RigidBody, Transform, World, system
from carom.ecs.column import Floats
from carom.systems.forces.law import Forces, Law, parameter, vector
from carom.systems.kernels.fields import add_well


@dataclass(frozen=True)
class GravityWell(Law):
    """F = G M m / r^2 towards a point; within its radius R, as inside an even ball, G M m r / R^3.

    Without a radius the pull has no end as r goes to 0, and no step is small enough there.
    """

    key: ClassVar[str] = "gravity_well"
    conservative: ClassVar[bool] = True
    strength: float = parameter(unit="m3/s2", doc="G M, 3.986e14 for the Earth", above=0.0)
    position: tuple[float, float, float] = vector(unit="m", doc="where it is", default=(0.0, 0.0, 0.0))
    radius: float = parameter(unit="m", doc="radius R within which the pull falls to 0", default=0.0, least=0.0)

    def energy(self, mass: Floats, center: Floats) -> float:
        """Return -G M m / r summed, and -G M m (3 R^2 - r^2) / (2 R^3) within the radius (J)."""
        away = center - np.array(self.position)
        squared = (away * away).sum(axis=1)
        inside = squared < self.radius**2
        distance = np.sqrt(np.where(inside, 1.0, squared))
        size = self.radius if self.radius > 0.0 else 1.0
        depth = np.where(inside, (3.0 * size * size - squared) / (2.0 * size**3), 1.0 / distance)
        return -self.strength * float((mass * depth).sum())


@system(reads=(Forces, Transform, RigidBody), adds=(Force,))
def apply_gravity_well(world: World, dt: float) -> None:
    """Add the pull of wells on centres of mass."""
    for law, rows in world[Forces].acting(GravityWell, world):
        transform, body = world[Transform], world[RigidBody]
        add_well(
            rows, law.strength, *law.position, law.radius, body.mass, body.center_of_mass,
            transform.position, transform.rotation, world[Force].force,
        )  # fmt: skip
