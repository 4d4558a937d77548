"""Magnus: what a ball that spins gets across its flight."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import ClassVar

from carom.ecs import Force, Motion, RigidBody, World, system
from carom.systems.forces.law import Forces, Law, parameter
from carom.systems.kernels.fields import add_magnus


@dataclass(frozen=True)
class Magnus(Law):
    """F = C pi r^3 rho (w x u), u the velocity through the medium, w the angular velocity.

    C = 1 is that of a slow smooth ball (Rubinow and Keller, J. Fluid Mech. 11, 447, 1961, eq. 1); fast ones have less.
    """

    key: ClassVar[str] = "magnus"
    radius: float = parameter(unit="m", doc="radius r of the ball", above=0.0)
    density: float = parameter(unit="kg/m3", doc="density rho of the medium", default=1.225, above=0.0)
    coefficient: float = parameter(unit="1", doc="factor C", default=1.0)


@system(reads=(Forces, RigidBody, Motion), adds=(Force,))
def apply_magnus(world: World, dt: float) -> None:
    """Add Magnus forces, by the velocities at the middle of the substep."""
    for law, rows in world[Forces].acting(Magnus, world):
        force, motion = world[Force], world[Motion]
        factor = law.coefficient * pi * (law.radius * law.radius * law.radius) * law.density
        add_magnus(rows, factor, motion.linear, motion.angular, force.medium, force.force)
