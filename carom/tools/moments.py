"""Moments: when a run is looked at, and where everything is just then."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import count, takewhile

import numpy as np

from carom.ecs import Transform
from carom.ecs.errors import CaromError
from carom.systems.interpolation import EarlierPoses
from carom.systems.simulation import Simulation

ROUNDING = 1e-9  # s, for steps that meet a moment but for rounding


def every(interval: float, start: float = 0.0, end: float = np.inf) -> Iterator[float]:
    """Return the times (s) from ``start`` to ``end``, ``interval`` apart."""
    return takewhile(lambda time: time <= end + ROUNDING, (start + number * interval for number in count()))


class Moments:
    """The times (s), in order, at which a run is looked at; ask `due` before the first step and after every one."""

    def __init__(self, times: Iterable[float]) -> None:
        self._times = iter(times)
        self._next = next(self._times, np.inf)
        self._earlier = EarlierPoses()
        self._before = np.nan

    @property
    def over(self) -> bool:
        """Whether none is left."""
        return self._next == np.inf

    def due(self, simulation: Simulation) -> list[tuple[float, Transform]]:
        """Return each time that has come since the last call, with the poses of all rows just then.

        Between two steps those are interpolated. Raises CaromError for a time that was over before.
        """
        world, now, found = simulation.world, simulation.time, []
        while self._next <= now + ROUNDING:
            if self._next >= now - ROUNDING:
                poses = world[Transform]
            elif self._next > self._before:
                poses = self._earlier.between(world, (self._next - self._before) / (now - self._before))
            else:
                since = now if np.isnan(self._before) else self._before
                raise CaromError(f"moments: {self._next:g} s cannot be seen any more at {since:g} s")
            found.append((self._next, poses))
            self._next = next(self._times, np.inf)
        if not self.over:
            self._earlier.keep(world)
            self._before = now
        return found
