"""Bounds: the boxes by which the broad phase finds who may meet."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, product
from typing import ClassVar

import numpy as np

from carom.ecs import Collider, ColliderPose
from carom.tools.marks import Lines, Mark, tinted
from carom.tools.overlays.overlay import Overlay, Seen

COLOR = (1.0, 0.85, 0.3)
CORNERS = np.array(list(product((0, 1), repeat=3)))
PAIRS = np.array(list(combinations(range(8), 2)))
EDGES = PAIRS[(CORNERS[PAIRS[:, 0]] != CORNERS[PAIRS[:, 1]]).sum(axis=1) == 1]


class BoundMarks(Overlay):
    """The edges of each collider's box, as the last step had it; faint behind bodies. Endless shapes have none."""

    key: ClassVar[str] = "bounds"

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return twelve lines for each box."""
        rows, pose = seen.world.row_numbers(Collider, ColliderPose), seen.world[ColliderPose]
        sides = np.stack([pose.lower[rows], pose.upper[rows]], axis=1)
        sides = sides[np.isfinite(sides).all(axis=(1, 2)) & (sides[:, 0] < sides[:, 1]).all(axis=1)]
        corners = sides[:, CORNERS, [0, 1, 2]]
        starts, ends = (corners[:, EDGES[:, end]].reshape(-1, 3) for end in (0, 1))
        return [Lines(starts, ends, tinted(COLOR, len(starts)), 1.5, behind=0.3)]
