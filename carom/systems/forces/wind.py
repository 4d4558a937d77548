"""Wind: the medium moves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from carom.ecs import Force, RigidBody, World, system
from carom.systems.forces.law import Forces, Law, vector


@dataclass(frozen=True)
class Wind(Law):
    """A uniform wind: every drag on these bodies is relative to it. Several winds add up."""

    key: ClassVar[str] = "wind"
    velocity: tuple[float, float, float] = vector(unit="m/s", doc="velocity of the air")


@system(reads=(Forces, RigidBody), adds=(Force,))
def apply_wind(world: World, dt: float) -> None:
    """Add the wind to the velocity of the medium around each body."""
    for wind, rows in world[Forces].acting(Wind, world):
        world[Force].medium[rows] += wind.velocity
