"""Persistence: which points of contact go on from step to step, since when, and with which impulse they began."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs import Collider, World
from carom.ecs.column import Floats, Integers
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.systems.constants import SAME_POINT
from carom.systems.settings import Settings


class Persistence:
    """Looked at after every step, it knows of the points of both tables of contacts, in order, since when they are.

    ``since`` (s) is the end of the step in which a point was found, ``began_with`` (N s) the normal impulse of a
    substep from which the solver set out, 0 for a cold start. A point goes on as the step has it: as that of its pair
    with the same feature, or else as the nearest of the pair that has none.
    """

    def __init__(self) -> None:
        self.since: Floats = np.zeros(0)
        self.began_with: Floats = np.zeros(0)
        self._keys: Integers = np.zeros((0, 3), np.int64)
        self._points, self._warm = np.zeros((0, 3)), np.zeros(0)

    def watch(self, world: World) -> None:
        """See the world after a step."""
        keys = np.stack([both(world, name) for name in ("a", "b", "feature")], axis=1)
        points, warm = both(world, "point"), both(world, "warm_normal")
        match = self._matches(world, keys, points)
        goes_on = match >= 0
        since = np.full(len(keys), world.frame * world[Settings].dt)
        since[goes_on] = self.since[match[goes_on]]
        began_with = np.zeros(len(keys))
        began_with[goes_on] = self._warm[match[goes_on]]
        self.since, self.began_with = since, began_with
        self._keys, self._points, self._warm = keys, points, warm

    def _matches(self, world: World, keys: Integers, points: Floats) -> Integers:
        """Return for each point which of the step before it goes on from, -1 for a new one."""
        match: Integers = np.full(len(keys), -1)
        wholes = (np.ascontiguousarray(columns).view("V24").ravel() for columns in (keys, self._keys))
        _, now, before = np.intersect1d(next(wholes), next(wholes), return_indices=True)
        match[now] = before
        left: defaultdict[tuple[int, int], list[int]] = defaultdict(list)
        for old in np.setdiff1d(np.arange(len(self._keys)), before).tolist():
            left[self._keys[old, 0], self._keys[old, 1]].append(old)
        for new in np.nonzero(match < 0)[0].tolist():
            olds = left.get((keys[new, 0], keys[new, 1]), [])
            away = np.linalg.norm(self._points[olds] - points[new], axis=1)
            if len(olds) and away.min() < SAME_POINT * _smaller_reach(world, keys[new, :2]):
                match[new] = olds.pop(int(away.argmin()))
        return match


def both(world: World, name: str) -> npt.NDArray[Any]:
    """Return a column of contacts and of those of bodies that sleep, one after the other."""
    return np.concatenate([getattr(world[kind], name)[: world[kind].count] for kind in (Contact, SleepingContact)])


def _smaller_reach(world: World, pair: Integers) -> float:
    """Return the longest half extent (m) of the smaller of two shapes; 0 where one is gone."""
    if not world.slots.live(pair).all():
        return 0.0
    rows, collider = world.slots.rows(pair), world[Collider]
    return float((collider.bound_half[rows].max(axis=1) + collider.bound_radius[rows]).min())
