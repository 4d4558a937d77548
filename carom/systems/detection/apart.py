"""Apart: pairs whose bounds overlap, but which are too far from each other for a contact, are not measured again."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.systems.kernels.apart import add_ways, keep_apart, leave_apart, note_apart
from carom.systems.resting import Resting
from carom.systems.threads import crew_for

NOBODY: Integers = np.empty((0, 2), np.int64)


class Apart(Resource):
    """How far pairs (n, 2) of collider rows were from touching when they were measured; a cache, droppable at any time.

    Colliders have gone a ``way`` (m), as they were ``seen`` (position, rotation) in one detection and the next. A pair
    stays apart ``until`` (n,) both ways are that less what it reaches: no points of the two can be nearer.
    """

    def __init__(self) -> None:
        self.pairs, self.until = NOBODY, np.empty(0)
        self.seen: Floats = np.zeros((0, 7))
        self.way: Floats = np.zeros(0)
        self.many = False  # whether more pairs are apart than there are colliders, which takes longer to see
        self._left = self._rows = 0

    def without(self, world: World, pairs: Integers, reaches: Floats) -> tuple[Integers, Floats]:
        """Return the sorted ``pairs`` (n, 2) that may be within their ``reaches`` (n,), m, and those."""
        collider, pose, rows = world[Collider], world[ColliderPose], world.row_numbers(Collider)
        self._left, self._rows = 0, len(rows)
        if not self.many:
            self.pairs = NOBODY
            return pairs, reaches
        if len(self.way) != len(collider.shape):
            self.seen, self.way = np.zeros((len(collider.shape), 7)), np.zeros(len(collider.shape))
        add_ways(
            crew_for(world, len(rows)), rows, collider.bound_center, collider.bound_half, collider.bound_radius,
            pose.position, pose.rotation, self.seen, self.way,
        )  # fmt: skip
        if not world[Resting].knows(world):
            self.pairs = NOBODY  # their shapes may be others
        if not np.array_equal(pairs, self.pairs):
            before = self.pairs, self.until
            self.pairs, self.until = pairs, np.empty(len(pairs))
            keep_apart(crew_for(world, len(pairs)), *before, self.pairs, self.until)
        near, near_reaches = np.empty_like(pairs), np.empty_like(reaches)
        count = leave_apart(pairs, reaches, self.until, self.way, collider.shape, near, near_reaches)
        self._left = len(pairs) - count
        return near[:count], near_reaches[:count]

    def note(self, world: World, measured: Integers, gaps: Floats, apart: int) -> None:
        """Remember how far those of the ``pairs`` are ``apart`` that were ``measured`` and have no points.

        Gaps (m) that are 0 or less say nothing.
        """
        self.many = bool(self._left + apart > self._rows)
        if apart and len(self.pairs):
            note_apart(crew_for(world, len(measured)), measured, gaps, self.pairs, self.way, self.until)
