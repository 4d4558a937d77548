"""Cameras: where a picture is taken from.

World frame right-handed, +y up by default; a camera looks along its own -z with +x to the right of the picture.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.errors import CaromError
from carom.ecs.spatial import affine, quaternion
from carom.ecs.spatial.projection import orthographic, perspective

Vector = tuple[float, float, float]
NEAR_PER_DISTANCE = 1.0 / 50.0  # with 24 bits of depth this resolves 3e-6 of the distance to the target
FAR_PER_DISTANCE = 100.0


@dataclass(frozen=True)
class Camera:
    """A perspective camera, or with ``height`` (m) an orthographic one, which sees so much from bottom to top.

    ``position``, ``target`` and ``up`` are in the world frame (m, m, 1); ``fov`` is the vertical field of view (rad);
    only what lies between ``near`` and ``far`` (m along the line of sight) is drawn, by default 1/50 and 100 times the
    distance to the target. ``sky_up`` is what is up in the world, for sky and sun, where it is not ``up``.
    """

    position: Vector
    target: Vector = (0.0, 0.0, 0.0)
    up: Vector = (0.0, 1.0, 0.0)
    fov: float = math.radians(45.0)
    near: float | None = None
    far: float | None = None
    height: float | None = None
    sky_up: Vector | None = None

    def __post_init__(self) -> None:
        """Refuse a camera that sees nothing; raise CaromError."""
        if not all(map(math.isfinite, (*self.position, *self.target))) or self.distance == 0.0:
            raise CaromError(
                f"camera: position and target must be finite and differ, received {self.position} and {self.target}"
            )
        if not all(map(math.isfinite, self.up)) or not any(self.up):
            raise CaromError(f"camera: up must be finite and not zero, received {self.up}")
        if not 0.0 < self.fov < math.pi:
            raise CaromError(f"camera: fov must lie between 0 and 180 deg, received {math.degrees(self.fov):g} deg")
        if self.height is not None and not 0.0 < self.height < math.inf:
            raise CaromError(f"camera: height must be above 0 m and finite, received {self.height:g} m")
        if not 0.0 < self.planes[0] < self.planes[1]:
            raise CaromError(
                f"camera: near must be above 0 m and below far, received {self.planes[0]:g} m and {self.planes[1]:g} m"
            )

    @property
    def distance(self) -> float:
        """Return how far the target is from the camera (m)."""
        return math.dist(self.position, self.target)

    @property
    def reach(self) -> float:
        """Return half the height of what is seen at the target (m)."""
        return self.distance * math.tan(self.fov / 2.0) if self.height is None else self.height / 2.0

    @property
    def zenith(self) -> Vector:
        """Return what is up in the world."""
        return self.up if self.sky_up is None else self.sky_up

    @property
    def planes(self) -> tuple[float, float]:
        """Return the distances of the near and the far plane (m)."""
        near = self.distance * NEAR_PER_DISTANCE if self.near is None else self.near
        far = self.distance * FAR_PER_DISTANCE if self.far is None else self.far
        return near, far

    def pose(self) -> Floats:
        """Return ``world_from_camera`` (4, 4)."""
        return standing(self.position, self.target, self.up)

    def projection(self, aspect: float) -> Floats:
        """Return the OpenGL projection (4, 4) for pictures of width over height ``aspect``."""
        if self.height is None:
            return perspective(self.fov, aspect, *self.planes)
        return orthographic(-self.reach * aspect, self.reach * aspect, -self.reach, self.reach, *self.planes)

    def metres(self, raw: npt.NDArray[np.float32]) -> Floats:
        """Return depths (m, along -z) by the values of a depth buffer, 0 at the near and 1 at the far plane."""
        near, far = self.planes
        share = raw.astype(np.float64)
        return near + share * (far - near) if self.height else near * far / (far - share * (far - near))


def standing(position: Vector, target: Vector, up: Vector) -> Floats:
    """Return the pose (4, 4) at ``position`` that looks at ``target``, with y as near to ``up`` as can be."""
    return affine.compose(position, quaternion.look_at(np.subtract(target, position), up))


def front(up: Vector) -> Floats:
    """Return the direction (3,) in which one who looks at a world stands: +z where y is up, -y where z is."""
    return np.array((0.0, -1.0, 0.0) if abs(up[2]) > abs(up[1]) else (0.0, 0.0, 1.0))
