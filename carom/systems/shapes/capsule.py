"""Capsule."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial.vector import normalise
from carom.systems.shapes.orientation import along_y
from carom.systems.shapes.revolved import cap, revolve
from carom.systems.shapes.shape import NO_AXES, Bounds, MassProperties, Shape, Surface, parameter

LOWER = [(radius, -height, -1.0) for radius, height in reversed(cap())]
UPPER = [(radius, height, 1.0) for radius, height in cap()]
ROUND = revolve(*LOWER, (1.0, 0.0, -1.0), (1.0, 0.0, 1.0), *UPPER)  # radius 1; its length lifts the ends apart


@dataclass(frozen=True)
class Capsule(Shape):
    """All points within ``radius`` of a segment of ``length`` along local y."""

    key: ClassVar[str] = "capsule"
    number: ClassVar[int] = 4
    along_z: ClassVar[bool] = True
    radius: float = parameter(unit="m", doc="radius", above=0.0)
    length: float = parameter(unit="m", doc="length of the straight part, caps excluded", above=0.0)

    def mass_properties(self) -> MassProperties:
        """Return the sums over a cylinder and two half balls, the latter moved out by Steiner's theorem."""
        r, half = self.radius, self.length / 2.0
        tube, ball = math.pi * r * r * self.length, 4.0 / 3.0 * math.pi * r**3
        axial = tube * r * r / 2.0 + ball * 0.4 * r * r
        across = tube * (r * r / 4.0 + half * half / 3.0) + ball * (0.4 * r * r + half * half + 0.75 * half * r)
        volume = tube + ball
        return MassProperties(volume, (0.0, 0.0, 0.0), (across / volume, axial / volume, across / volume), NO_AXES)

    def bounds(self) -> Bounds:
        """Return the segment widened by the radius."""
        return Bounds((0.0, 0.0, 0.0), (0.0, self.length / 2.0, 0.0), self.radius)

    def support(self, directions: Floats) -> Floats:
        """Return r d / |d| about the end of the segment that is farther, the upper for a level direction."""
        points = self.radius * normalise(directions)
        points[:, 1] += np.where(directions[:, 1] < 0.0, -self.length / 2.0, self.length / 2.0)
        return points

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL capsule, which lies along z (`Shape.along_z`)."""
        import fcl

        return fcl.Capsule(self.radius + margin, self.length)

    def surface(self) -> Surface:
        """Return a capsule of 4,096 triangles."""
        from trimesh.creation import capsule

        mesh = capsule(height=self.length, radius=self.radius)
        return Surface(along_y(np.asarray(mesh.vertices)), np.asarray(mesh.faces), True)

    def corners(self, towards: tuple[float, float, float]) -> tuple[Floats, float]:
        """Return the ends of the segment with the radius."""
        half = self.length / 2.0
        return np.array([[0.0, -half, 0.0], [0.0, half, 0.0]]), self.radius

    @classmethod
    def submerged(cls, size: Floats, geometry: Any, normal: Floats, depth: Floats) -> Floats:
        """Return those of prisms with facetted caps."""
        return ROUND.submerged(size.take((0, 0, 0), axis=1), 0.5 * size[:, 1], normal, depth)
