"""Plane: the half space behind it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial.vector import normalise
from carom.systems.constants import ALONG_NORMAL, NORMAL_LENGTH
from carom.systems.shapes.shape import NO_AXES, Bounds, MassProperties, Shape, Surface, parameter

DRAWN_EXTENT = 100.0


@dataclass(frozen=True)
class Plane(Shape):
    """Everything where ``normal . x < offset`` is solid; the normal is normalised. Only static entities have planes."""

    key: ClassVar[str] = "plane"
    number: ClassVar[int] = 2
    static: ClassVar[bool] = True
    normal: tuple[float, float, float] = field(
        default=(0.0, 1.0, 0.0), metadata={"unit": "1", "doc": "outward normal, any length but 0", "width": 3}
    )
    offset: float = parameter(unit="m", doc="distance of the plane from the origin along the normal", default=0.0)

    def __post_init__(self) -> None:
        """Normalise the normal; raise DeclarationError for a zero one."""
        super().__post_init__()
        normal: tuple[float, ...] = self.normal
        if not 0.0 < math.sqrt(sum(c * c for c in normal)) < math.inf:  # squares no float holds
            largest = max(map(abs, normal))
            normal = tuple(c / largest for c in normal)
        length = math.sqrt(sum(c * c for c in normal))
        if abs(length - 1.0) > NORMAL_LENGTH:
            normal = tuple(c / length for c in normal)
        object.__setattr__(self, "normal", normal)

    def faults(self) -> list[tuple[str, str]]:
        """Return a fault for a normal without direction."""
        found = super().faults()
        if not found and not any(self.normal):
            found.append(("normal", "must have a direction, received a zero vector"))
        return found

    def mass_properties(self) -> MassProperties:
        """Return an infinite volume: planes are static."""
        return MassProperties(math.inf, (0.0, 0.0, 0.0), (math.inf,) * 3, NO_AXES)

    def bounds(self) -> Bounds:
        """Return endless bounds; the broad phase tests planes against boxes instead."""
        return Bounds((0.0, 0.0, 0.0), (math.inf,) * 3, 0.0)

    def support(self, directions: Floats) -> Floats:
        """Return the foot of the origin along the normal; in any other direction there is no end."""
        normal = np.array(self.normal)
        along = np.abs(normalise(directions) - normal).max(axis=1) < ALONG_NORMAL
        endless = np.where(directions == 0.0, 0.0, np.copysign(np.inf, directions))
        return np.where(along[:, None], self.offset * normal, endless)

    def fcl_geometry(self, margin: float = 0.0) -> Any:
        """Return an FCL half space; moving it out by the margin is exact."""
        import fcl

        return fcl.Halfspace(np.array(self.normal), self.offset + margin)

    def surface(self) -> Surface:
        """Return a square of 100 m around the foot of the origin."""
        normal = np.array(self.normal)
        across = np.cross(normal, [0.0, 0.0, 1.0] if abs(normal[2]) < 0.9 else [1.0, 0.0, 0.0])
        across /= np.linalg.norm(across)
        along = np.cross(normal, across)
        half = DRAWN_EXTENT / 2.0
        corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
        vertices = np.array([self.offset * normal + a * across + b * along for a, b in corners])
        return Surface(vertices, np.array([[0, 1, 2], [0, 2, 3]]), False)
