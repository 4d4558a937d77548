"""Trails: the way each moving body has gone over the last seconds."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from itertools import pairwise
from typing import ClassVar

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.systems.bodies import centers_of_mass
from carom.systems.settings import time_of
from carom.tools.marks import Lines, Mark, tinted
from carom.tools.overlays.overlay import Overlay, Seen

COLOR = (0.35, 0.8, 1.0)
SECONDS = 3.0
ROUNDING = 1e-9  # s, for steps that meet a picture's time but for rounding
WIDEST, THINNEST = 2.6, 0.6  # px, of the newest and the oldest part


class TrailMarks(Overlay):
    """Where centres of mass were after each step, thinner the longer ago, and faint behind bodies."""

    key: ClassVar[str] = "trails"

    def __init__(self) -> None:
        self._past: deque[tuple[float, Integers, Floats]] = deque()

    def watch(self, world: World) -> None:
        """Keep where bodies are now."""
        time = time_of(world)
        rows = world.row_numbers(Transform, Motion, RigidBody)
        self._past.append((time, world.entities(rows), centers_of_mass(world, rows)))
        while self._past[0][0] < time - SECONDS:
            self._past.popleft()

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return the ways between every two steps until now; who was not there in both has none."""
        rows = seen.world.row_numbers(Transform, Motion, RigidBody)
        now = seen.time, seen.world.entities(rows), seen.centers(rows)
        past = [*(one for one in self._past if one[0] < seen.time - ROUNDING), now]
        ways, ages = [np.zeros((0, 2, 3))], [np.zeros(0)]
        for (_, before, starts), (time, after, ends) in pairwise(past):
            _, one, other = np.intersect1d(before, after, assume_unique=True, return_indices=True)
            ways.append(np.stack([starts[one], ends[other]], axis=1))
            ages.append(np.full(len(one), seen.time - time))
        joined = np.concatenate(ways)
        moved = (joined[:, 0] != joined[:, 1]).any(axis=1)
        widths = WIDEST + (THINNEST - WIDEST) * np.concatenate(ages)[moved] / SECONDS
        return [Lines(joined[moved, 0], joined[moved, 1], tinted(COLOR, len(widths)), widths, behind=0.25)]
