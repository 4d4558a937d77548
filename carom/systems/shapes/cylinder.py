"""Cylinder."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.systems.shapes.orientation import along_y
from carom.systems.shapes.revolved import revolve
from carom.systems.shapes.rim import farthest_on_rim, rim_points
from carom.systems.shapes.shape import NO_AXES, Bounds, MassProperties, Shape, Surface, parameter

ROUND = revolve((1.0, -0.5, 0.0), (1.0, 0.5, 0.0))  # radius 1 and length 1


@dataclass(frozen=True)
class Cylinder(Shape):
    """A round cylinder along local y."""

    key: ClassVar[str] = "cylinder"
    number: ClassVar[int] = 5
    along_z: ClassVar[bool] = True
    radius: float = parameter(unit="m", doc="radius", above=0.0)
    length: float = parameter(unit="m", doc="length along y", above=0.0)

    def mass_properties(self) -> MassProperties:
        """Return pi r^2 l, r^2 / 2 about the axis and r^2 / 4 + l^2 / 12 across."""
        r, length = self.radius, self.length
        axial, across = r * r / 2.0, r * r / 4.0 + length * length / 12.0
        return MassProperties(math.pi * r * r * length, (0.0, 0.0, 0.0), (across, axial, across), NO_AXES)

    def bounds(self) -> Bounds:
        """Return the box around it."""
        return Bounds((0.0, 0.0, 0.0), (self.radius, self.length / 2.0, self.radius), 0.0)

    def support(self, directions: Floats) -> Floats:
        """Return the point of the upper or lower rim, the upper for a level direction."""
        points = farthest_on_rim(self.radius, directions)
        points[:, 1] = np.where(directions[:, 1] < 0.0, -self.length / 2.0, self.length / 2.0)
        return points

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL cylinder, which lies along z (`Shape.along_z`)."""
        import fcl

        return fcl.Cylinder(self.radius + margin, self.length + 2.0 * margin)

    def surface(self) -> Surface:
        """Return a cylinder of 48 facets."""
        from trimesh.creation import cylinder

        mesh = cylinder(radius=self.radius, height=self.length, sections=48)
        return Surface(along_y(np.asarray(mesh.vertices)), np.asarray(mesh.faces), False)

    def corners(self, towards: tuple[float, float, float]) -> tuple[Floats, float]:
        """Return points on both rims, the first of each being its farthest ``towards``."""
        ends = (-self.length / 2.0, self.length / 2.0)
        return np.concatenate([rim_points(self.radius, end, towards) for end in ends]), 0.0

    @classmethod
    def submerged(cls, size: Floats, geometry: Any, normal: Floats, depth: Floats) -> Floats:
        """Return those of prisms."""
        return ROUND.submerged(size.take((0, 1, 0), axis=1), np.zeros(len(size)), normal, depth)
