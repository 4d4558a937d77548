"""Continuous: bodies that are fast for their size are looked after on their way, so that they pass through nobody."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from carom.ecs import Collider, ColliderPose, Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.meshes import Indices, PackedMeshes, Singles
from carom.systems.detection.narrow import Found
from carom.systems.kernels.cores import CORE
from carom.systems.kernels.fast_pairs import (
    NUMBERS,
    TRIANGLE_CORNERS,
    find_agreeing,
    find_far,
    find_fast,
    let_go,
    place_fast,
)
from carom.systems.kernels.meeting import foresee_meetings


class Looked(NamedTuple):
    """What `foresee_meetings` reads of pairs that are looked after, a mesh first; poses are those on their bodies."""

    bodies: Integers
    numbers: Floats
    cores: Floats
    roots: Integers  # of a mesh's tree, -1 of another shape
    position: Floats
    rotation: Floats

    @classmethod
    def room(cls, numbers: Floats) -> Looked:
        """Return room for as many pairs as there are ``numbers`` of, to be written."""
        n = len(numbers)
        return cls(
            np.empty((n, 2), np.int64), numbers, np.zeros((n, 2 * CORE)), np.empty(n, np.int64),
            np.empty((n, 2, 3)), np.empty((n, 2, 4)),
        )  # fmt: skip

    def take(self, which: Any) -> Looked:
        """Return some of them."""
        return Looked(*(column[which] for column in self))


class Land(NamedTuple):
    """The trees of meshes, and the vertices of all hulls with room for those of a triangle behind them."""

    bounds: Singles
    nodes: Indices
    triangles: Floats
    room: Floats


NOBODY = Looked.room(np.empty((0, NUMBERS)))
NOWHERE = Land(np.empty(0, np.float32), np.empty(0, np.int32), np.empty(0), np.zeros((TRIANGLE_CORNERS, 3)))


class Fast(Resource):
    """The pairs (n, 2) of collider rows that are looked after, a mesh first, and what is looked at.

    ``turns`` are by how much (rad) each body may turn in the rest of a substep in which it was struck before it is
    looked after too; infinity for most.
    """

    def __init__(self) -> None:
        self.pairs: Integers = np.empty((0, 2), np.int64)
        self.looked, self.land = NOBODY, NOWHERE
        self.turns: Floats = np.zeros(0)
        self._limited = False  # whether some of them are finite

    def find(self, world: World, pairs: Integers, found: Found, span: float) -> None:
        """Find who of ``pairs`` (n, 2) is to be looked after within ``span`` seconds, by what is ``found`` of them."""
        collider, pose, motion = world[Collider], world[ColliderPose], world[Motion]
        center = world[Flight].detected_center
        self.pairs, numbers = fast_of(world, pairs, span)
        self.looked = Looked.room(numbers) if len(numbers) else NOBODY
        count, size = len(self.pairs), len(motion.asleep)
        if self._limited or len(self.turns) != size:
            self.turns, self._limited = np.full(size, np.inf), False
        if not count:
            return
        given, reaches = self.pairs.copy(), numbers.copy()
        hulls, meshes = world[PackedHulls].holding(world), world[PackedMeshes].holding(world)
        room = np.concatenate([hulls.vertices, np.zeros((TRIANGLE_CORNERS, 3))])
        self.land, self._limited = Land(meshes.bounds, meshes.nodes, meshes.triangles, room), True
        place_fast(
            self.pairs, collider.shape, collider.size, collider.geometry, pose.body_row, pose.position, pose.rotation,
            center, world[Transform].rotation, hulls, meshes.root, *self.looked, self.turns,
        )  # fmt: skip
        times, agrees = self._times(world, center, span, first_only=False), np.empty(count, np.bool_)
        find_agreeing(
            given, reaches, times, span, found.row_a, found.row_b, found.normal, found.depth, found.point,
            pose.body_row, center, motion.linear, motion.angular, agrees,
        )  # fmt: skip
        self.pairs, self.looked = self.pairs[~agrees], self.looked.take(~agrees)

    def trusted(self, found: Found) -> Found:
        """Return what is found, but of pairs that are looked after only what is near: the rest is found on the way."""
        if not len(self.pairs):
            return found
        far = np.empty(len(found.row_a), np.bool_)
        number = find_far(self.pairs, self.looked.numbers, found.row_a, found.row_b, found.depth, far)
        return found.without(far) if number else found

    def let_go(self, contact: Contact) -> None:
        """Let contacts of pairs that are looked after strike again, whose bodies may turn onto another point."""
        if len(self.pairs):
            let_go(self.pairs, contact.count, contact.row_a, contact.row_b, contact.resting)

    def next_look(self, world: World, span: float) -> float:
        """Return in how many seconds somebody is to be detected anew as all move now; infinity beyond ``span``."""
        if not len(self.pairs):
            return np.inf
        time = float(self._times(world, world[Flight].center, span, first_only=True).min())
        return time if time < span else np.inf

    def _times(self, world: World, center: Floats, span: float, *, first_only: bool) -> Floats:
        """Return when (n,) each pair is to be looked at again."""
        motion, times = world[Motion], np.empty(len(self.pairs))
        foresee_meetings(
            span, first_only, center, world[Transform].rotation, motion.linear, motion.angular, world[Flight].felt,
            *self.looked, *self.land, times,
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
