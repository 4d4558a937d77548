"""Attraction: a point that pulls, or pushes away, by a power of the distance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from carom.ecs import Force, RigidBody, Transform, World, system
from carom.ecs.column import Floats
from carom.systems.forces.law import Forces, Law, parameter, vector
from carom.systems.kernels.fields import add_central


@dataclass(frozen=True)
class Attraction(Law):
    """F = k r^n towards a point, r in m, whatever the body's mass; below 0, k pushes away. At the point it is 0."""

    key: ClassVar[str] = "attraction"
    conservative: ClassVar[bool] = True
    strength: float = parameter(unit="N", doc="force k at a distance of 1 m")
    power: float = parameter(unit="1", doc="whole power n of the distance", default=-2.0, least=-8.0, most=8.0)
    position: tuple[float, float, float] = vector(unit="m", doc="the point", default=(0.0, 0.0, 0.0))

    def __post_init__(self) -> None:
        """Refuse a power that is not whole, which takes logarithms that differ by processor."""
        super().__post_init__()
        self.refuse_unless(self.power == int(self.power), "power", f"must be whole, received {self.power:g}")

    def energy(self, mass: Floats, center: Floats) -> float:
        """Return k r^(n + 1) / (n + 1) summed, or k log r (J)."""
        away = center - np.array(self.position)
        distance = np.sqrt((away * away).sum(axis=1))
        distance = distance[distance > 0.0]
        if self.power == -1.0:
            return self.strength * float(np.log(distance).sum())
        return self.strength * float((distance ** (self.power + 1.0)).sum()) / (self.power + 1.0)


@system(reads=(Forces, Transform, RigidBody), adds=(Force,))
def apply_attraction(world: World, dt: float) -> None:
    """Add the pull of points on centres of mass."""
    for law, rows in world[Forces].acting(Attraction, world):
        transform, body = world[Transform], world[RigidBody]
        add_central(
            rows, law.strength, int(law.power), *law.position, body.center_of_mass,
            transform.position, transform.rotation, world[Force].force,
        )  # fmt: skip
