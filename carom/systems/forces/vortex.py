"""Vortex: the medium turns about an axis, as a whirlwind or a drain does."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from carom.ecs import Force, RigidBody, Transform, World, system
from carom.systems.forces.law import Forces, Law, parameter, vector
from carom.systems.kernels.fields import add_vortex


@dataclass(frozen=True)
class Vortex(Law):
    """A medium that goes round an axis at C / (2 pi r), and within the core like a solid; drags are relative to it.

    Rankine's vortex: Lamb, Hydrodynamics, 1932, article 159.
    """

    key: ClassVar[str] = "vortex"
    moves_medium: ClassVar[bool] = True
    circulation: float = parameter(unit="m2/s", doc="circulation C about the axis, right-handed")
    position: tuple[float, float, float] = vector(unit="m", doc="a point of the axis", default=(0.0, 0.0, 0.0))
    axis: tuple[float, float, float] = vector(unit="1", doc="along the axis", default=(0.0, 1.0, 0.0))
    core: float = parameter(unit="m", doc="radius of the core", default=1.0, above=0.0)
    rise: float = parameter(unit="m/s", doc="speed of the medium along the axis within the core", default=0.0)

    def __post_init__(self) -> None:
        """Refuse an axis without direction."""
        super().__post_init__()
        self.refuse_unless(any(self.axis), "axis", "must have a direction, received all 0")


@system(reads=(Forces, RigidBody, Transform), adds=(Force,))
def apply_vortex(world: World, dt: float) -> None:
    """Add vortices to the velocity of the medium around each body."""
    for law, rows in world[Forces].acting(Vortex, world):
        add_vortex(
            rows, law.circulation, law.core, law.rise, *law.position, *law.axis, world[Transform].position,
            world[Force].medium,
        )  # fmt: skip
