"""Mutual gravitation: every body attracts every other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from carom.ecs import Force, RigidBody, Transform, World, system
from carom.ecs.column import Floats
from carom.systems.bodies import centers_of_mass
from carom.systems.forces.law import Forces, Law, parameter
from carom.systems.gravitation import attract
from carom.systems.settings import Settings
from carom.systems.threads import Threads, crew_for

NEWTON = 6.67430e-11  # m3/(kg s2), CODATA 2018


@dataclass(frozen=True)
class MutualGravitation(Law):
    """F = G m1 m2 / r^2 between centres of mass; with softening s, r^2 becomes r^2 + s^2 (Plummer).

    Without softening the pull has no end as r goes to 0; two at one point do not pull each other.
    """

    key: ClassVar[str] = "mutual_gravitation"
    conservative: ClassVar[bool] = True
    constant: float = parameter(unit="m3/(kg s2)", doc="gravitational constant G", default=NEWTON, above=0.0)
    softening: float = parameter(unit="m", doc="length below which the pull no longer grows", default=0.0)
    opening: float = parameter(
        unit="1", doc="size over distance up to which bodies of thousands pull as one", default=0.6, least=0.0, most=1.0
    )

    @property
    def steady(self) -> bool:
        """Whether it stays the same: no, it changes as soon as anybody moves."""
        return False

    def energy(self, mass: Floats, center: Floats) -> float:
        """Return -G m1 m2 / r of every two (J), r softened as the force is."""
        return attract(mass, center, self.constant, self.softening, self.opening)[1]


@system(reads=(Forces, Transform, RigidBody, Threads, Settings), adds=(Force,))
def apply_mutual_gravitation(world: World, dt: float) -> None:
    """Add the attraction between every two bodies, equal and opposite."""
    for law, rows in world[Forces].acting(MutualGravitation, world):
        mass, center = world[RigidBody].mass[rows], centers_of_mass(world, rows)
        words = law.constant, law.softening, law.opening
        world[Force].force[rows] += attract(mass, center, *words, crew_for(world, len(rows)))[0]
