"""Apart: pairs whose bounds overlap, but which are too far from each other for a contact, are not measured again."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.systems.kernels.apart import add_ways, keep_apart, leave_apart, note_apart
from carom.systems.resting import Resting

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
        self._make_room(0)

    def _make_room(self, pairs: int) -> None:
        """Make room that lasts: to ask for it in each step takes longer than what is written there."""
        self._near, self._reaches = np.empty((pairs, 2), np.int64), np.empty(pairs)
        self._lists: list[tuple[Integers, Floats]] = [(np.empty((pairs, 2), np.int64), np.empty(pairs)) for _ in (0, 1)]

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
            rows, collider.bound_center, collider.bound_half, collider.bound_radius, pose.position, pose.rotation,
            self.seen, self.way,
        )  # fmt: skip
        if not world[Resting].knows(world):
            self.pairs = NOBODY  # their shapes may be others
        if not np.array_equal(pairs, self.pairs):
            if len(pairs) > len(self._near):
                self._make_room(2 * len(pairs))
            self._lists.reverse()
            now, until = self._lists[0]
            keep_apart(self.pairs, self.until, pairs, now, until)
            self.pairs, self.until = now[: len(pairs)], until[: len(pairs)]
        count = leave_apart(pairs, reaches, self.until, self.way, self._near, self._reaches)
        self._left = len(pairs) - count
        return self._near[:count], self._reaches[:count]

    def note(self, measured: Integers, points: Integers, gaps: Floats) -> None:
        """Remember how far those of the ``pairs`` are apart that were ``measured`` and have no points.

        Gaps (m) that are 0 or less say nothing.
        """
        apart = np.count_nonzero((points == 0) & (gaps > 0.0))
        self.many = bool(self._left + apart > self._rows)
        if apart and len(self.pairs):
            note_apart(measured, gaps, self.pairs, self.way, self.until)
