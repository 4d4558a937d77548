"""Cone."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.systems.shapes.revolved import revolve
from carom.systems.shapes.rim import farthest_on_rim, rim_points
from carom.systems.shapes.shape import NO_AXES, Bounds, MassProperties, Shape, Surface, parameter

SIDES = 48  # flat sides it is drawn with

ROUND = revolve((1.0, -0.5, 0.0), (0.0, 0.5, 0.0))  # radius 1 and length 1


@dataclass(frozen=True)
class Cone(Shape):
    """A round cone along local y, its apex up, the origin half way between apex and base."""

    key: ClassVar[str] = "cone"
    number: ClassVar[int] = 8
    along_z: ClassVar[bool] = True
    radius: float = parameter(unit="m", doc="radius of the base", above=0.0)
    length: float = parameter(unit="m", doc="height from base to apex", above=0.0)

    def mass_properties(self) -> MassProperties:
        """Return pi r^2 l / 3, the centre l / 4 above the base, 3/10 r^2 about the axis, 3/20 r^2 + 3/80 l^2 across.

        Spiegel, Theoretical Mechanics, 1967, table 9-2, with the moment across moved to the centre by Steiner.
        """
        r, length = self.radius, self.length
        axial, across = 0.3 * r * r, 0.15 * r * r + 0.0375 * length * length
        center = (0.0, -length / 4.0, 0.0)
        return MassProperties(math.pi * r * r * length / 3.0, center, (across, axial, across), NO_AXES)

    def bounds(self) -> Bounds:
        """Return the box around it."""
        return Bounds((0.0, 0.0, 0.0), (self.radius, self.length / 2.0, self.radius), 0.0)

    def support(self, directions: Floats) -> Floats:
        """Return the apex, or the point of the base's rim where that is farther."""
        half = self.length / 2.0
        points = farthest_on_rim(self.radius, directions) - [0.0, half, 0.0]
        rim = points[:, 0] * directions[:, 0] + points[:, 2] * directions[:, 2]
        points[self.length * directions[:, 1] > rim] = (0.0, half, 0.0)
        return points

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL cone along z (`Shape.along_z`); it cannot grow exactly, so the margin is left out."""
        import fcl

        return fcl.Cone(self.radius, self.length)

    def surface(self) -> Surface:
        """Return a cone of 48 sides."""
        angles = np.arange(SIDES) * (2.0 * math.pi / SIDES)
        half, level = self.length / 2.0, np.full(SIDES, -self.length / 2.0)
        rim = np.stack([self.radius * np.cos(angles), level, self.radius * np.sin(angles)], axis=1)
        here, following = np.arange(SIDES), (np.arange(SIDES) + 1) % SIDES
        apex, middle = np.full(SIDES, SIDES), np.full(SIDES, SIDES + 1)
        sides, base = np.stack([here, apex, following], axis=1), np.stack([middle, here, following], axis=1)
        vertices = np.concatenate([rim, [[0.0, half, 0.0], [0.0, -half, 0.0]]])
        return Surface(vertices, np.concatenate([sides, base]), False)

    def corners(self, towards: tuple[float, float, float]) -> tuple[Floats, float]:
        """Return the apex and points of the rim, the first of these being its farthest ``towards``."""
        half = self.length / 2.0
        return np.concatenate([rim_points(self.radius, -half, towards), [[0.0, half, 0.0]]]), 0.0

    @classmethod
    def submerged(cls, size: Floats, geometry: Any, normal: Floats, depth: Floats) -> Floats:
        """Return those of pyramids."""
        return ROUND.submerged(size.take((0, 1, 0), axis=1), np.zeros(len(size)), normal, depth)
