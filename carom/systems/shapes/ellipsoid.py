"""Ellipsoid."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial.vector import normalise
from carom.systems.kernels.submersion import FOUND, submerge_balls
from carom.systems.shapes.ball_surface import ball_surfaces
from carom.systems.shapes.shape import NO_AXES, Bounds, MassProperties, Shape, Surface


@dataclass(frozen=True)
class Ellipsoid(Shape):
    """A ball stretched along the local axes."""

    key: ClassVar[str] = "ellipsoid"
    number: ClassVar[int] = 9
    radii: tuple[float, float, float] = field(
        metadata={"unit": "m", "doc": "half axes along x, y and z", "above": 0.0, "width": 3}
    )

    def mass_properties(self) -> MassProperties:
        """Return 4/3 pi a b c and (b^2 + c^2) / 5: a ball's 2/5 r^2 is two fifths of each squared axis over two."""
        a, b, c = self.radii
        moments = ((b * b + c * c) / 5.0, (a * a + c * c) / 5.0, (a * a + b * b) / 5.0)
        return MassProperties(4.0 / 3.0 * math.pi * a * b * c, (0.0, 0.0, 0.0), moments, NO_AXES)

    def bounds(self) -> Bounds:
        """Return the half axes."""
        return Bounds((0.0, 0.0, 0.0), self.radii, 0.0)

    def support(self, directions: Floats) -> Floats:
        """Return R^2 d / |R d| with the half axes R: the ball's answer in the stretched frame."""
        return np.asarray(normalise(directions * self.radii) * self.radii)

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return FCL's ellipsoid; it cannot grow exactly, so the margin is left out."""
        import fcl

        return fcl.Ellipsoid(*self.radii)

    def surface(self) -> Surface:
        """Return a stretched icosphere of 1,280 triangles."""
        return ball_surfaces(np.array(self.radii))[0]

    def coarser_surfaces(self) -> tuple[Surface, ...]:
        """Return stretched icospheres of 320 and of 80 triangles."""
        return ball_surfaces(np.array(self.radii))[1:]

    def corners(self, towards: tuple[float, float, float]) -> tuple[Floats, float]:
        """Return its farthest point ``towards``."""
        return self.support(np.array([towards])), 0.0

    @classmethod
    def submerged(cls, size: Floats, geometry: Any, normal: Floats, depth: Floats) -> Floats:
        """Return caps."""
        found = np.empty((len(depth), FOUND))
        submerge_balls(np.ascontiguousarray(size[:, :3]), normal, depth, found)
        return found
