"""Sphere."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial.vector import normalise
from carom.systems.kernels.submersion import FOUND, submerge_balls
from carom.systems.shapes.ball_surface import ball_surfaces
from carom.systems.shapes.shape import NO_AXES, Bounds, MassProperties, Shape, Surface, parameter


@dataclass(frozen=True)
class Sphere(Shape):
    """A ball."""

    key: ClassVar[str] = "sphere"
    number: ClassVar[int] = 0
    radius: float = parameter(unit="m", doc="radius", above=0.0)

    def mass_properties(self) -> MassProperties:
        """Return 4/3 pi r^3 and 2/5 r^2."""
        moment = 0.4 * self.radius * self.radius
        return MassProperties(4.0 / 3.0 * math.pi * self.radius**3, (0.0, 0.0, 0.0), (moment,) * 3, NO_AXES)

    def bounds(self) -> Bounds:
        """Return a point widened by the radius."""
        return Bounds((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), self.radius)

    def support(self, directions: Floats) -> Floats:
        """Return r d / |d|."""
        return self.radius * normalise(directions)

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL sphere; growing it is exact."""
        import fcl

        return fcl.Sphere(self.radius + margin)

    def surface(self) -> Surface:
        """Return an icosphere of 1,280 triangles."""
        return ball_surfaces(np.full(3, self.radius))[0]

    def coarser_surfaces(self) -> tuple[Surface, ...]:
        """Return icospheres of 320 and of 80 triangles."""
        return ball_surfaces(np.full(3, self.radius))[1:]

    def corners(self, towards: tuple[float, float, float]) -> tuple[Floats, float]:
        """Return the centre with the radius."""
        return np.zeros((1, 3)), self.radius

    @classmethod
    def submerged(cls, size: Floats, geometry: Any, normal: Floats, depth: Floats) -> Floats:
        """Return caps."""
        found = np.empty((len(depth), FOUND))
        submerge_balls(np.repeat(size[:, :1], 3, axis=1), normal, depth, found)
        return found
