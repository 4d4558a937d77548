"""Constant push: the same force everywhere, or over a stroke as in a gun barrel."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from carom.ecs import Force, RigidBody, World, system
from carom.ecs.components.flight import Flight
from carom.systems.forces.law import Forces, Law, parameter, vector
from carom.systems.kernels.forces import add_push


@dataclass(frozen=True)
class ConstantPush(Law):
    """A force in one direction; with a stroke, only while the body is within it along the force from ``start``.

    The substep in which the body leaves the stroke gets just the part of the force that it was inside for, so that the
    work done is force times stroke.
    """

    key: ClassVar[str] = "constant_push"
    force: tuple[float, float, float] = vector(unit="N", doc="force")
    start: tuple[float, float, float] = vector(unit="m", doc="where the stroke begins", default=(0.0, 0.0, 0.0))
    stroke: float = parameter(unit="m", doc="length along the force over which it acts", default=math.inf, above=0.0)


@system(reads=(Forces, RigidBody, Flight), adds=(Force,))
def apply_constant_push(world: World, dt: float) -> None:
    """Add constant pushes; last of the forces, since leaving a stroke depends on all others."""
    for law, rows in world[Forces].acting(ConstantPush, world):
        flight, body = world[Flight], world[RigidBody]
        add_push(
            rows, dt, *law.force, *law.start, law.stroke, body.inverse_mass, body.freedom,
            flight.start_center, flight.start_linear, world[Force].force,
        )  # fmt: skip
