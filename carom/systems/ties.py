"""Ties: which bodies joints hold together, awake or asleep."""

from __future__ import annotations

import numpy as np

from carom.ecs import ColliderPose, RigidBody, World
from carom.ecs.column import Booleans, Integers
from carom.ecs.component import Resource
from carom.ecs.components.joint import Joint
from carom.systems.ends import ends_there


class Ties(Resource):
    """The joints (rows) that hold somebody, and the bodies (rows, -1 for what stands) that they hold; a cache.

    ``row_a`` and ``row_b`` are the entities that joints name, -1 for the world. A joint of which one is gone
    holds nobody. ``restless`` are bodies of motors that want to move. ``version`` changes with all of it.
    """

    def __init__(self) -> None:
        self.structure, self.version = -1, 0
        nobody: Integers = np.zeros(0, np.int64)
        self.rows = self.row_a = self.row_b = self.body_a = self.body_b = nobody
        self.restless = self.apart = self.keys = nobody

    def now(self, world: World) -> Ties:
        """Return the ties, found anew where entities have come or gone."""
        if self.structure != world.structure:
            self.find(world)
        return self

    def find(self, world: World) -> bool:
        """Find the ties; tell whether other bodies are held than before."""
        joint, is_body = world[Joint], world.table(RigidBody).present
        self.structure = world.structure
        self.version += 1
        before = self.body_a, self.body_b
        rows, row_a, row_b = ends_there(world, Joint)
        body_a, body_b = (np.where((of >= 0) & is_body[of], of, -1) for of in (row_a, row_b))
        there = _pushed(world, body_a) | _pushed(world, body_b)
        self.rows, self.row_a, self.row_b = rows[there], row_a[there], row_b[there]
        self.body_a, self.body_b = body_a[there], body_b[there]
        turns = ((joint.speed[self.rows] != 0.0) & joint.driven[self.rows]).any(axis=1)
        self.restless = _bodies(self.body_a[turns], self.body_b[turns])
        apart = ~joint.collide[self.rows]
        ends = (np.where(body >= 0, body, row) for body, row in ((self.body_a, self.row_a), (self.body_b, self.row_b)))
        self.apart = np.where(apart, _keys(*ends), -1)
        self.keys = np.unique(self.apart[apart])
        return not (np.array_equal(before[0], self.body_a) and np.array_equal(before[1], self.body_b))

    @property
    def bodies(self) -> Integers:
        """The bodies that are held, in order."""
        return _bodies(self.body_a, self.body_b)

    def keeping_apart(self, a: int, b: int) -> Integers:
        """Return the joints (rows) that keep two bodies, or what stands, given by their rows, from touching."""
        return np.asarray(self.rows[self.apart == _keys(np.array(a), np.array(b))])

    def without_joined(self, world: World, pairs: Integers) -> Integers:
        """Return ``pairs`` (n, 2) of collider rows without those that joints keep from touching each other."""
        if not (len(pairs) and len(self.now(world).keys)):
            return pairs
        bodies = world[ColliderPose].body_row[pairs]
        owners = np.where(bodies >= 0, bodies, pairs)
        keys = _keys(owners[:, 0], owners[:, 1])
        place = np.minimum(np.searchsorted(self.keys, keys), len(self.keys) - 1)
        return np.asarray(pairs[self.keys[place] != keys])


def _pushed(world: World, body: Integers) -> Booleans:
    return np.asarray((body >= 0) & (world[RigidBody].inverse_mass[body] > 0.0))


def _bodies(a: Integers, b: Integers) -> Integers:
    both = np.unique(np.concatenate([a, b]))
    return np.asarray(both[both >= 0])


def _keys(a: Integers, b: Integers) -> Integers:
    return np.asarray((np.minimum(a, b) << 32) | np.maximum(a, b))
