"""Joints: where bodies are held, and the lines along which ropes, rods and springs pull."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.components.joint import LINE, Joint
from carom.ecs.components.spring import Spring
from carom.ecs.spatial import quaternion
from carom.systems.ends import ends_there
from carom.tools.marks import Lines, Mark, Points, tinted
from carom.tools.overlays.overlay import Overlay, Seen

LINES, POINTS = (0.22, 0.25, 0.3), (1.0, 0.75, 0.2)
WIDTH, SIZE = 2.0, 6.0  # px


class JointMarks(Overlay):
    """A line from anchor to anchor for ropes, distances and springs, and a dot at the anchor of b for all others."""

    key: ClassVar[str] = "joints"

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return the lines, which bodies hide, and the dots, which shine through."""
        joint = seen.world[Joint]
        of_joints, starts, ends = anchors(seen, Joint)
        _, pulled, pulling = anchors(seen, Spring)
        line = joint.along[of_joints] == LINE
        starts, dots, ends = np.concatenate([starts[line], pulled]), ends[~line], np.concatenate([ends[line], pulling])
        return [
            Lines(starts, ends, tinted(LINES, len(starts)), WIDTH, behind=0.2),
            Points(dots, tinted(POINTS, len(dots)), SIZE, behind=0.5),
        ]


def anchors(seen: Seen, kind: type[Joint] | type[Spring]) -> tuple[Integers, Floats, Floats]:
    """Return the rows (n,) of joints or springs, and where their anchors are drawn (n, 3), m, of a and of b."""
    rows, row_a, row_b = ends_there(seen.world, kind)
    table = seen.world[kind]
    pairs = ((row_a, table.anchor_a[rows]), (row_b, table.anchor_b[rows]))
    places = [np.where((row >= 0)[:, None], carried(seen, row, anchor), anchor) for row, anchor in pairs]
    return rows, places[0], places[1]


def carried(seen: Seen, rows: Integers, points: Floats) -> Floats:
    """Return points (n, 3) in the frames of entities (rows) where they are drawn."""
    return seen.transform.position[rows] + quaternion.rotate(seen.transform.rotation[rows], points)
