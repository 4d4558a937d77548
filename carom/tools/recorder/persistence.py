"""Persistence: which points of contact go on from step to step, since when, and with which impulse they began."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs import Collider, World
from carom.ecs.column import Floats, Integers
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.systems.constants import SAME_POINT
from carom.systems.settings import time_of


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
        since = np.full(len(keys), time_of(world))
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
        new, old = np.nonzero(match < 0)[0], np.setdiff1d(np.arange(len(self._keys)), before)
        one, other = _of_one_pair(keys[new], self._keys[old])
        new, old = new[one], old[other]
        away = np.linalg.norm(points[new] - self._points[old], axis=1)
        near = away < SAME_POINT * _smaller_reaches(world, keys[new, :2])
        order = np.nonzero(near)[0][np.lexsort((away[near], new[near]))]
        taken: set[int] = set()
        for one_new, one_old in zip(new[order].tolist(), old[order].tolist(), strict=True):
            if match[one_new] < 0 and one_old not in taken:
                match[one_new] = one_old
                taken.add(one_old)
        return match


def both(world: World, name: str) -> npt.NDArray[Any]:
    """Return a column of contacts and of those of bodies that sleep, one after the other."""
    return np.concatenate([getattr(world[kind], name)[: world[kind].count] for kind in (Contact, SleepingContact)])


def _of_one_pair(some: Integers, others: Integers) -> tuple[Integers, Integers]:
    """Return the places of every two points, one of each list (n, 3) and (m, 3), that are of the same two colliders."""
    pairs = np.ascontiguousarray(np.concatenate([some, others])[:, :2]).view("V16").ravel()
    pair = np.unique(pairs, return_inverse=True)[1].ravel()
    here, there = pair[: len(some)], pair[len(some) :]
    order = np.argsort(there, kind="stable")
    first, last = (np.searchsorted(there[order], here, side) for side in ("left", "right"))
    counts = last - first
    within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.repeat(np.arange(len(some)), counts), order[np.repeat(first, counts) + within]


def _smaller_reaches(world: World, pairs: Integers) -> Floats:
    """Return the longest half extent (m) of the smaller of two shapes (n, 2), handles; 0 where one is gone."""
    live, collider = world.slots.live(pairs.ravel()), world[Collider]
    rows = world.slots.rows(pairs.ravel()[live])
    reach = np.zeros(pairs.size)
    reach[live] = collider.bound_half[rows].max(axis=1) + collider.bound_radius[rows]
    return np.asarray(reach.reshape(pairs.shape).min(axis=1))
