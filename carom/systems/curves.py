"""Curves: smooth ways through points that are passed at given times."""

from __future__ import annotations

import numpy as np

from carom.ecs.column import Booleans, Floats
from carom.ecs.components.path import Repeat
from carom.systems.kernels.keyframes import find_moments


class Curve:
    """A way through ``points`` (n, size), each passed at its time of ``at`` (n,), s, with a velocity without jumps.

    It leaves a point towards the one after it as it came from the one before: E. Catmull and R. Rom, A class of local
    interpolating splines, 1974, over times that need not be even. It rests at both ends, unless it is a loop, which
    sets out at the speed it comes back with, and at a point that is also the next or the one before.
    """

    def __init__(self, at: Floats, points: Floats, repeat: Repeat) -> None:
        self._at, self._points, self._repeat = at, points, repeat
        ahead, wait = np.diff(points, axis=0), np.diff(at)
        if repeat == Repeat.LOOP:
            ahead, wait = np.vstack([ahead[-1:], ahead, ahead[:1]]), np.concatenate([wait[-1:], wait, wait[:1]])
        else:
            ahead, wait = np.pad(ahead, ((1, 1), (0, 0))), np.pad(wait, 1)
        moves: Booleans = np.any(ahead, axis=1)
        velocity = (ahead[1:] + ahead[:-1]) / (wait[1:] + wait[:-1])[:, None]
        self._velocity = np.where((moves[1:] & moves[:-1])[:, None], velocity, 0.0)

    def point(self, time: float) -> Floats:
        """Return where it is (size,) at a time, s; before the first and after the last point it is there."""
        one, before, share = np.array([0]), np.zeros(1, np.int64), np.zeros(1)
        find_moments(one, time, one, np.array([len(self._at)]), np.array([self._repeat.value]), self._at, before, share)
        k, s = int(before[0]), float(share[0])
        step = self._at[k + 1] - self._at[k]
        start, way = self._points[k], self._points[k + 1] - self._points[k]
        leaving, coming = step * self._velocity[k : k + 2]
        found: Floats = start + s * way + s * (1.0 - s) * ((1.0 - s) * (leaving - way) + s * (way - coming))
        return found
