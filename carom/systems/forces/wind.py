"""Wind: the medium moves, evenly or in gusts."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from typing import ClassVar

from carom.ecs import Force, RigidBody, World, system
from carom.systems.forces.gusts import WAVES, waves
from carom.systems.forces.law import Forces, Law, parameter, vector
from carom.systems.kernels.gusts import add_gust
from carom.systems.progress import Progress
from carom.systems.settings import Settings


@dataclass(frozen=True)
class Wind(Law):
    """A wind that is the same everywhere: every drag on these bodies is relative to it. Several winds add up.

    Gusts are smooth noise about the velocity, the same for the same seed of the world: along each axis with the
    standard deviation ``gust``, alike for about ``gust_time``, and none faster than 10 rad in it. See `waves`.
    """

    key: ClassVar[str] = "wind"
    moves_medium: ClassVar[bool] = True
    velocity: tuple[float, float, float] = vector(unit="m/s", doc="velocity of the air")
    gust: float = parameter(unit="m/s", doc="standard deviation of gusts along each axis", default=0.0, least=0.0)
    gust_time: float = parameter(unit="s", doc="time over which gusts are alike", default=1.0, above=0.0)

    @property
    def steady(self) -> bool:
        """Whether it stays the same."""
        return self.gust == 0.0


@system(reads=(Forces, RigidBody, Progress, Settings), adds=(Force,))
def apply_wind(world: World, dt: float) -> None:
    """Add the wind, in the middle of the substep, to the velocity of the medium around each body."""
    medium = world[Force].medium
    for number, (wind, rows) in enumerate(world[Forces].acting(Wind, world)):
        medium[rows] += wind.velocity
        if wind.gust > 0.0:
            time = (world[Progress].clock + 0.5 * dt) / wind.gust_time
            add_gust(rows, wind.gust * sqrt(2.0 / WAVES), time, *waves(world[Settings].seed, number), medium)
