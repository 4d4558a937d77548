"""Sun: where the light comes from, and the cube in which things cast shadows."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.tools.cameras import Camera, Vector, front

DIRECTION = (-0.75, 1.3, 0.35)  # towards the sun: to the left of who stands in front of the world, up, and to the front
REACH = 1.5  # half edge of the cube over half the width of the picture at the target, at least
STEP = 1.5  # cubes grow by this factor, so that shadows keep their edges while a camera comes nearer
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


def sun_for(camera: Camera, aspect: float, texels: int) -> Sun:
    """Return the sun for a view, with a shadow map of ``texels`` along each edge.

    It stands still in the world. The cube moves by whole texels and grows in steps, so that a texel shows the same
    place from picture to picture, and shadows do not shimmer while the camera moves.
    """
    least = REACH * camera.reach * max(aspect, 1.0)
    reach = STEP ** math.ceil(math.log(least, STEP) - 1e-9)
    axes = sun_axes(camera.zenith)
    texel = 2.0 * reach / texels
    pose = np.eye(4)
    pose[:3, :3] = axes
    pose[:3, 3] = axes @ (np.round(camera.target @ axes / texel) * texel + (0.0, 0.0, DISTANCE * reach))
    return Sun(pose, reach)


def sun_axes(up: Vector) -> Floats:
    """Return the axes of the sun's camera as columns (3, 3): across, across and up, and towards the sun."""
    zenith = np.array(up) / np.linalg.norm(up)
    right = np.cross(zenith, front(up))
    right /= np.linalg.norm(right)
    towards = np.column_stack([right, zenith, np.cross(right, zenith)]) @ DIRECTION
    return quaternion.matrix(quaternion.look_at(-towards, zenith))
