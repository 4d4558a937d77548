"""Tether: a spring to a point."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from carom.ecs import Force, RigidBody, Transform, World, system
from carom.systems.forces.law import Forces, Law, parameter, vector
from carom.systems.places import placed


@dataclass(frozen=True)
class Tether(Law):
    """F = -k (x - anchor)."""

    key: ClassVar[str] = "tether"
    stiffness: float = parameter(unit="N/m", doc="stiffness k", above=0.0)
    anchor: tuple[float, float, float] = vector(unit="m", doc="where it is fixed", default=(0.0, 0.0, 0.0))


@placed(after="apply_quadratic_drag")
@system(reads=(Forces, Transform, RigidBody), adds=(Force,))
def apply_tether(world: World, dt: float) -> None:
    """Add what tethers pull."""
    for law, rows in world[Forces].acting(Tether, world):
        world[Force].force[rows] -= law.stiffness * (world[Transform].position[rows] - np.array(law.anchor))
