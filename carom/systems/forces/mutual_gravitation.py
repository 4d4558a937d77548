"""Mutual gravitation: every body attracts every other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from carom.ecs import Force, RigidBody, Transform, World, system
from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.forces.law import Forces, Law, parameter
from carom.systems.kernels.forces import add_attraction

NEWTON = 6.67430e-11  # m3/(kg s2), CODATA 2018


@dataclass(frozen=True)
class MutualGravitation(Law):
    """F = G m1 m2 / r^2 between centres of mass; with softening s, r^2 becomes r^2 + s^2 (Plummer)."""

    key: ClassVar[str] = "mutual_gravitation"
    conservative: ClassVar[bool] = True
    constant: float = parameter(unit="m3/(kg s2)", doc="gravitational constant G", default=NEWTON, above=0.0)
    softening: float = parameter(unit="m", doc="length below which the pull no longer grows", default=0.0)

    @property
    def steady(self) -> bool:
        """Whether it stays the same: no, it changes as soon as anybody moves."""
        return False

    def energy(self, mass: Floats, center: Floats) -> float:
        """Return -G m1 m2 / r of every two (J), r softened as the force is."""
        first, second = np.triu_indices(len(mass), 1)
        gap = center[first] - center[second]
        distance = np.sqrt((gap * gap).sum(axis=1) + self.softening**2)
        return -self.constant * float((mass[first] * mass[second] / distance).sum())


@system(reads=(Forces, Transform, RigidBody), adds=(Force,))
def apply_mutual_gravitation(world: World, dt: float) -> None:
    """Add the attraction between every two bodies, equal and opposite."""
    for law, rows in world[Forces].acting(MutualGravitation, world):
        transform, body = world[Transform], world[RigidBody]
        center = transform.position.copy()
        center[rows] += quaternion.rotate(transform.rotation[rows], body.center_of_mass[rows])
        add_attraction(rows, body.mass, center, law.constant, law.softening, world[Force].force)
