"""View: where in a picture things of the world are."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from carom.ecs.column import Booleans, Floats
from carom.tools.cameras import Camera

FULL = 480  # px: in higher pictures widths of marks grow with the height
NEARER = 0.005  # of its distance, by which what is drawn on a surface is taken to be in front of it


@dataclass(frozen=True)
class View:
    """What a camera shows in a picture of ``width`` by ``height`` px."""

    camera: Camera
    width: int
    height: int

    @cached_property
    def _camera_from_world(self) -> Floats:
        return np.asarray(np.linalg.inv(self.camera.pose()), np.float64)

    @cached_property
    def _clip_from_camera(self) -> Floats:
        return self.camera.projection(self.width / self.height)

    @property
    def magnification(self) -> float:
        """How many times wider than stated marks are drawn."""
        return max(1.0, self.height / FULL)

    @property
    def metres_per_pixel(self) -> float:
        """Return how large a pixel is at the camera's target (m)."""
        return 2.0 * self.camera.reach / self.height

    def ahead(self, points: Floats) -> Floats:
        """Return how far ahead of the camera points (n, 3) are, m."""
        return np.asarray(-self._before_camera(points)[:, 2])

    def pixels_per_metre(self, points: Floats) -> Floats:
        """Return how large a metre across the line of sight is at points (n, 3), px; 0 behind the near plane."""
        if self.camera.height is not None:
            return np.full(len(points), 1.0 / self.metres_per_pixel)
        ahead = self.ahead(points)
        seen = ahead > self.camera.planes[0]
        return np.where(seen, self.camera.distance / np.where(seen, ahead, 1.0), 0.0) / self.metres_per_pixel

    def pixels(self, points: Floats) -> Floats:
        """Return x, y (px from the corner on top and left) and depth (0 near, 1 far) of points (n, 3), m.

        Those behind the near plane are not numbers.
        """
        seen = self._before_camera(points)
        seen[-seen[:, 2] <= self.camera.planes[0]] = np.nan
        return self._on_screen(seen)

    def contains(self, points: Floats) -> Booleans:
        """Tell which of points (n, 3) lie in the picture, whatever is in front of them."""
        x, y, _ = self.pixels(points).T
        return np.asarray((x >= 0.0) & (x <= self.width) & (y >= 0.0) & (y <= self.height))

    def segments(self, starts: Floats, ends: Floats) -> tuple[Floats, Floats]:
        """Return both ends (n, 3) as `pixels`, of what is left of segments beyond the near plane."""
        one, other = self._before_camera(starts), self._before_camera(ends)
        beyond, other_beyond = (-point[:, 2] - self.camera.planes[0] for point in (one, other))
        crosses = beyond * other_beyond < 0.0
        share = np.divide(beyond, beyond - other_beyond, out=np.zeros_like(beyond), where=crosses)
        crossing = one + share[:, None] * (other - one)
        one[beyond < 0.0], other[other_beyond < 0.0] = crossing[beyond < 0.0], crossing[other_beyond < 0.0]
        one[(beyond < 0.0) & (other_beyond < 0.0)] = np.nan
        return self._on_screen(one), self._on_screen(other)

    def _before_camera(self, points: Floats) -> Floats:
        turn, shift = self._camera_from_world[:3, :3], self._camera_from_world[:3, 3]
        return np.asarray(np.asarray(points, np.float64).reshape(-1, 3) @ turn.T + shift)

    def _on_screen(self, seen: Floats) -> Floats:
        nearer = seen * [1.0, 1.0, 1.0 - NEARER]
        places, depths = (np.column_stack([at, np.ones(len(at))]) @ self._clip_from_camera.T for at in (seen, nearer))
        found = np.empty_like(seen)
        found[:, 0] = (0.5 + 0.5 * places[:, 0] / places[:, 3]) * self.width
        found[:, 1] = (0.5 - 0.5 * places[:, 1] / places[:, 3]) * self.height
        found[:, 2] = 0.5 + 0.5 * depths[:, 2] / depths[:, 3]
        return found
