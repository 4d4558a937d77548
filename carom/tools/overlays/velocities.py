"""Velocities: an arrow from each moving body's centre of mass."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from carom.ecs import Motion, RigidBody, Transform
from carom.tools.marks import Arrows, Mark, tinted
from carom.tools.overlays.overlay import Overlay, Scaling, Seen

COLOR = (0.25, 0.9, 0.45)


class VelocityMarks(Overlay):
    """Arrows over everything, since each begins inside of its body."""

    key: ClassVar[str] = "velocities"

    def __init__(self) -> None:
        self._scaling = Scaling()

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return an arrow for each body."""
        world = seen.world
        rows = world.row_numbers(Transform, Motion, RigidBody)
        starts = seen.centers(rows)
        ends = starts + self._scaling.metres(world[Motion].linear[rows], seen)
        return [Arrows(starts, ends, tinted(COLOR, len(rows))), *self._scaling.key("velocity", "m/s", COLOR, seen)]
