"""Axes: the frames of the world and of the bodies, x red, y green, z blue."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from carom.ecs import RigidBody, Transform
from carom.ecs.spatial import quaternion
from carom.tools.marks import Arrows, Labels, Mark
from carom.tools.overlays.overlay import Overlay, Seen

COLORS = np.array([(0.95, 0.3, 0.3, 1.0), (0.35, 0.85, 0.35, 1.0), (0.4, 0.6, 1.0, 1.0)])
OF_BODIES, OF_WORLD = 0.07, 0.15  # of the picture's height at the camera's target


class AxisMarks(Overlay):
    """Three arrows for each body from its origin, over everything, and longer ones at the world's, with letters."""

    key: ClassVar[str] = "axes"

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return the arrows and the letters of the world's."""
        rows, transform = seen.world.row_numbers(RigidBody, Transform), seen.transform
        turned = quaternion.matrix(transform.rotation[rows]).transpose(0, 2, 1).reshape(-1, 3)
        starts = np.repeat(transform.position[rows], 3, axis=0)
        ends = seen.metres(OF_WORLD) * np.eye(3)
        return [
            Arrows(starts, starts + seen.metres(OF_BODIES) * turned, np.tile(COLORS, (len(rows), 1)), 2.0),
            Arrows(np.zeros((3, 3)), ends, COLORS, 2.5, behind=0.4),
            Labels(ends, "xyz", COLORS),
        ]
