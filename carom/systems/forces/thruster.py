"""Thruster: a force that is fixed to a body and turns with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from carom.ecs import Force, RigidBody, Transform, World, system
from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion
from carom.systems.forces.law import Forces, Law, vector
from carom.systems.kernels.fields import add_thrust


@dataclass(frozen=True)
class Thruster(Law):
    """A force in the frame of the body, at a point of it: off the centre of mass it turns the body as well."""

    key: ClassVar[str] = "thruster"
    force: tuple[float, float, float] = vector(unit="N", doc="force, frame of the body")
    at: tuple[float, float, float] = vector(unit="m", doc="where it acts, frame of the body", default=(0.0, 0.0, 0.0))

    def points(self, world: World, rows: Integers) -> Floats:
        """Return where the thrust acts."""
        transform = world[Transform]
        return np.asarray(transform.position[rows] + quaternion.rotate(transform.rotation[rows], np.array(self.at)))


@system(reads=(Forces, Transform, RigidBody), adds=(Force,))
def apply_thruster(world: World, dt: float) -> None:
    """Add the thrust of each body and its torque about the centre of mass."""
    for law, rows in world[Forces].acting(Thruster, world):
        force = world[Force]
        add_thrust(
            rows, *law.force, *law.at, world[RigidBody].center_of_mass, world[Transform].rotation,
            force.force, force.torque,
        )  # fmt: skip
