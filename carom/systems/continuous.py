"""Continuous: bodies that are fast for their size are looked after on their way, so that they pass through nobody."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.meshes import PackedMeshes
from carom.systems.detection.narrow import Found
from carom.systems.kernels.fast_pairs import NUMBERS, find_agreeing, find_fast, place_fast
from carom.systems.kernels.meeting import foresee_meetings


class Fast(Resource):
    """The pairs (n, 2) of collider rows that are looked after, a mesh first, and where they are on their bodies.

    ``turns`` are by how much (rad) each body may turn in the rest of a substep in which it was struck before it is
    looked after too; infinity for most.
    """

    def __init__(self) -> None:
        self.pairs: Integers = np.empty((0, 2), np.int64)
        self.turns: Floats = np.zeros(0)
        self._limited = False  # whether some of them are finite

    def find(self, world: World, pairs: Integers, found: Found, span: float) -> None:
        """Find who of ``pairs`` (n, 2) is to be looked after within ``span`` seconds, by what is ``found`` of them."""
        collider, pose, motion = world[Collider], world[ColliderPose], world[Motion]
        center = world[Flight].detected_center
        self.pairs, self.numbers = fast_of(world, pairs, span)
        count, size = len(self.pairs), len(motion.asleep)
        if self._limited or len(self.turns) != size:
            self.turns, self._limited = np.full(size, np.inf), False
        if not count:
            return
        given, reaches = self.pairs.copy(), self.numbers.copy()
        self.position, self.rotation = np.empty((count, 2, 3)), np.empty((count, 2, 4))
        self._limited = True
        place_fast(
            self.pairs, self.numbers, collider.shape, pose.body_row, pose.position, pose.rotation,
            center, world[Transform].rotation, self.position, self.rotation, self.turns,
        )  # fmt: skip
        times, agrees = self._times(world, center, span, first_only=False), np.empty(count, np.bool_)
        find_agreeing(
            given, reaches, times, span, found.row_a, found.row_b, found.normal, found.depth, found.point,
            pose.body_row, center, motion.linear, motion.angular, agrees,
        )  # fmt: skip
        self.pairs, self.numbers = self.pairs[~agrees], self.numbers[~agrees]
        self.position, self.rotation = self.position[~agrees], self.rotation[~agrees]

    def trusted(self, found: Found) -> Found:
        """Return what is found, but of pairs that are looked after only what is near: the rest is found on the way."""
        if not len(self.pairs):
            return found
        pair = self._pair_of(found.row_a, found.row_b)
        far = (pair >= 0) & (-found.depth > self.numbers[pair, 3])
        return found.take(~far) if far.any() else found

    def let_go(self, contact: Contact) -> None:
        """Let contacts of pairs that are looked after strike again, whose bodies may turn onto another point."""
        if len(self.pairs):
            count = contact.count
            contact.resting[:count] &= self._pair_of(contact.row_a[:count], contact.row_b[:count]) < 0

    def _pair_of(self, row_a: Integers, row_b: Integers) -> Integers:
        """Return which of the pairs two rows (n,) are, the lower one first; -1 for none."""
        scale = 1 + max(int(self.pairs.max()), int(row_b.max(initial=0)), int(row_a.max(initial=0)))
        keys = self.pairs.min(axis=1) * scale + self.pairs.max(axis=1)
        order = np.argsort(keys)
        place = order[np.minimum(np.searchsorted(keys[order], held := row_a * scale + row_b), len(keys) - 1)]
        return np.where(keys[place] == held, place, -1)

    def next_look(self, world: World, span: float) -> float:
        """Return in how many seconds somebody is to be detected anew as all move now; infinity beyond ``span``."""
        if not len(self.pairs):
            return np.inf
        time = float(self._times(world, world[Flight].center, span, first_only=True).min())
        return time if time < span else np.inf

    def _times(self, world: World, center: Floats, span: float, *, first_only: bool) -> Floats:
        """Return when (n,) each pair is to be looked at again."""
        collider, motion, times = world[Collider], world[Motion], np.empty(len(self.pairs))
        hulls, meshes = world[PackedHulls].holding(world), world[PackedMeshes].holding(world)
        room: Floats = np.concatenate([hulls.vertices, np.zeros((3, 3))])
        foresee_meetings(
            self.pairs, self.numbers, span, first_only, collider.shape, collider.size, collider.geometry,
            world[ColliderPose].body_row, center, world[Transform].rotation, motion.linear, motion.angular,
            world[Flight].felt, self.position, self.rotation, hulls, meshes, room, times,
        )  # fmt: skip
        return times


def fast_of(world: World, pairs: Integers, span: float) -> tuple[Integers, Floats]:
    """Return who of ``pairs`` (n, 2) is fast enough within ``span`` seconds to be looked after, and their numbers."""
    fast, numbers = np.empty_like(pairs), np.empty((len(pairs), NUMBERS))
    if not len(pairs):
        return fast, numbers
    collider, pose, motion, body = world[Collider], world[ColliderPose], world[Motion], world[RigidBody]
    count = find_fast(
        pairs, span, collider.shape, collider.position, collider.bound_center, collider.bound_half,
        collider.bound_radius, pose.position, pose.body_row, world[Flight].detected_center, body.inverse_mass,
        body.continuous, motion.linear, motion.angular, fast, numbers,
    )  # fmt: skip
    return fast[:count], numbers[:count]
