"""Drag: linear and quadratic resistance of a medium, applied exponentially so that it never overshoots."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from carom.ecs import Force, Motion, RigidBody, World, system
from carom.systems.forces.law import Forces, Law, parameter
from carom.systems.kernels.forces import add_linear_drag, add_quadratic_drag


@dataclass(frozen=True)
class LinearDrag(Law):
    """F = -c (v - medium): slow bodies in thick fluids (Stokes: c = 6 pi viscosity radius)."""

    key: ClassVar[str] = "linear_drag"
    coefficient: float = parameter(unit="kg/s", doc="drag coefficient c", above=0.0)


@dataclass(frozen=True)
class QuadraticDrag(Law):
    """F = -1/2 rho Cd A |v - medium| (v - medium): fast bodies in air or water."""

    key: ClassVar[str] = "quadratic_drag"
    area: float = parameter(unit="m2", doc="frontal area A", above=0.0)
    drag_coefficient: float = parameter(unit="1", doc="drag coefficient Cd, 0.47 for a ball", default=0.47, above=0.0)
    density: float = parameter(unit="kg/m3", doc="density rho of the medium", default=1.225, above=0.0)

    @property
    def factor(self) -> float:
        """What the square of the speed is to be multiplied with (kg/m)."""
        return 0.5 * self.density * self.drag_coefficient * self.area


@system(reads=(Forces, RigidBody), adds=(Force,))
def apply_linear_drag(world: World, dt: float) -> None:
    """Add linear drag as a rate."""
    for law, rows in world[Forces].acting(LinearDrag, world):
        force = world[Force]
        add_linear_drag(rows, law.coefficient, force.medium, force.drag, force.drag_flow)


@system(reads=(Forces, RigidBody, Motion), adds=(Force,))
def apply_quadratic_drag(world: World, dt: float) -> None:
    """Add quadratic drag as a rate, by the speed at the middle of the substep."""
    for law, rows in world[Forces].acting(QuadraticDrag, world):
        force = world[Force]
        add_quadratic_drag(rows, law.factor, force.medium, world[Motion].linear, force.drag, force.drag_flow)
