"""Sun: where the light comes from, and the cube in which things cast shadows."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carom.ecs.column import Floats
from carom.tools.cameras import Camera, standing

DIRECTION = (-0.75, 1.3, 0.35)  # towards the sun, in the camera's right, the world's up, and away from the target
REACH = 1.5  # half edge of the largest cube over half the width of the picture at the target
STEP = 1.5  # cubes shrink by this factor, not smoothly, so that shadows do not shimmer while bodies move
DISTANCE = 4.0  # from the target to the sun, over half the edge of the cube: what is higher casts no shadow


@dataclass(frozen=True)
class Sun:
    """A directional light: ``pose`` (4, 4) of its camera in the world, ``reach`` half the edge of its cube (m)."""

    pose: Floats
    reach: float

    @property
    def direction(self) -> Floats:
        """Return the unit vector (3,) towards the sun."""
        return self.pose[:3, 2]

    def view(self) -> Floats:
        """Return ``sun_from_world`` (4, 4)."""
        return np.asarray(np.linalg.inv(self.pose), np.float64)

    def projection(self) -> Floats:
        """Return the orthographic projection (4, 4) of the cube."""
        matrix = np.diag([1.0 / self.reach, 1.0 / self.reach, -1.0 / (DISTANCE * self.reach), 1.0])
        matrix[2, 3] = -1.0
        return matrix


def sun_for(camera: Camera, aspect: float, spread: float) -> Sun:
    """Return the sun for a view whose things to be shaded lie within ``spread`` (m) of the camera's target."""
    widest = REACH * camera.distance * math.tan(camera.fov / 2.0) * max(aspect, 1.0)
    steps = math.floor(math.log(widest / spread, STEP)) if 0.0 < spread < widest else 0
    reach = widest / STEP**steps
    up = np.array(camera.up) / np.linalg.norm(camera.up)
    right = camera.pose()[:3, 0]
    towards = np.column_stack([right, up, np.cross(right, up)]) @ DIRECTION
    target = np.array(camera.target)
    position = target + DISTANCE * reach / float(np.linalg.norm(towards)) * towards
    return Sun(standing(tuple(position), tuple(target), tuple(right)), reach)
