"""Lift: what a wing gets across the air it goes through."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from carom.ecs import Force, Motion, RigidBody, Transform, World, system
from carom.systems.forces.law import Forces, Law, parameter, vector
from carom.systems.kernels.fields import add_lift


@dataclass(frozen=True)
class Lift(Law):
    """F = 1/2 rho CL A |u| (s x u), u the velocity through the medium, s the unit vector along the span.

    It is across the flight and the span, so it does no work; its drag is a `quadratic_drag` of its own. With the span
    to the right of the flight it is up.
    """

    key: ClassVar[str] = "lift"
    area: float = parameter(unit="m2", doc="area A of the wing", above=0.0)
    lift_coefficient: float = parameter(unit="1", doc="lift coefficient CL; below 0 it presses down", default=1.0)
    density: float = parameter(unit="kg/m3", doc="density rho of the medium", default=1.225, above=0.0)
    span: tuple[float, float, float] = vector(
        unit="1", doc="along the span, frame of the body", default=(1.0, 0.0, 0.0)
    )

    def __post_init__(self) -> None:
        """Refuse a span without direction."""
        super().__post_init__()
        self.refuse_unless(any(self.span), "span", "must have a direction, received all 0")


@system(reads=(Forces, RigidBody, Motion, Transform), adds=(Force,))
def apply_lift(world: World, dt: float) -> None:
    """Add lift, by the velocity at the middle of the substep."""
    for law, rows in world[Forces].acting(Lift, world):
        force = world[Force]
        factor = 0.5 * law.density * law.lift_coefficient * law.area
        add_lift(
            rows, factor, *law.span, world[Transform].rotation, world[Motion].linear, force.medium, force.force
        )  # fmt: skip
