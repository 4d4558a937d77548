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
from carom.systems.kernels.fast_pairs import (
    NUMBERS,
    TRIANGLE_CORNERS,
    find_far,
    find_fast,
    let_go,
    place_fast,
)
from carom.systems.kernels.meeting import foresee_meetings
from carom.systems.kernels.trust import find_agreeing, spend_trust
from carom.systems.looked import NO_PAIRS, NOWHERE, FastPairs, Land, Looked
from carom.systems.progress import Progress


class Fast(Resource):
    """The pairs (n, 2) of collider rows that are looked after, a mesh first, and what is looked at.

    ``left`` (n,) is how far (m) the bodies of each may still move before what is known of their contacts is no longer
    trusted, 0 where nothing is. ``trusts`` (rows, 3) say of each body how far its contacts are, how far (m) it reaches
    from its centre, and how fast (m/s) those come whom it may meet.
    """

    def __init__(self) -> None:
        self._fast = NO_PAIRS
        self.pairs, self.looked, self.left = NO_PAIRS[:3]
        self.land = NOWHERE
        self.trusts: Floats = np.zeros((0, 3))
        self._limited = False  # whether some of them are finite
        self._span, self._linear, self._angular = 0.0, NOWHERE.room, NOWHERE.room  # when they were found

    def find(self, world: World, pairs: Integers, found: Found, span: float) -> None:
        """Find who of ``pairs`` (n, 2) is to be looked after within ``span`` seconds, by what is ``found`` of them."""
        collider, pose, motion = world[Collider], world[ColliderPose], world[Motion]
        center = world[Flight].detected_center
        fast, numbers = fast_of(world, pairs, span)
        size = len(motion.asleep)
        if self._limited or len(self.trusts) != size:
            self.trusts, self._limited = np.tile([np.inf, 0.0, 0.0], (size, 1)), False
        if not len(fast):
            self._fast, self.pairs, self.looked, self.left = NO_PAIRS, *NO_PAIRS[:3]
            return
        self._fast = one = FastPairs.of(fast, Looked.room(numbers))
        given, reaches = fast.copy(), numbers.copy()
        hulls, meshes = world[PackedHulls].holding(world), world[PackedMeshes].holding(world)
        room = np.concatenate([hulls.vertices, np.zeros((TRIANGLE_CORNERS, 3))])
        self.land, self._limited = Land(meshes.bounds, meshes.nodes, meshes.triangles, room), True
        place_fast(
            fast, collider.shape, collider.size, collider.geometry, pose.body_row, pose.position, pose.rotation,
            center, world[Transform].rotation, motion.linear, motion.angular, hulls, meshes.root, *one.looked,
            self.trusts,
        )  # fmt: skip
        times, agrees = self._times(world, one, center, span, found=True), np.empty(len(fast), np.bool_)
        find_agreeing(
            given, reaches, times, span, found.row_a, found.row_b, found.normal, found.depth, found.point,
            pose.body_row, center, motion.linear, motion.angular, agrees, one.left,
        )  # fmt: skip
        one.asked[:] = ~agrees
        self._span, self._linear, self._angular = span, np.array(motion.linear), np.array(motion.angular)
        self._ask()

    def _ask(self) -> None:
        asked = self._fast.asked
        self.pairs, self.looked = self._fast.pairs[asked], self._fast.looked.take(asked)
        self.left = self._fast.left[asked]

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

    def next_look(self, world: World, span: float, *, found: bool) -> float:
        """Return in how many seconds somebody is to be detected anew as all move now; infinity beyond ``span``.

        Contacts have just been ``found``, or what was is trusted for as long as it lasts.
        """
        if not len(self.pairs):
            return np.inf
        times = self._times(world, self, world[Flight].center, span, found=found, first_only=True)
        time = float(times.min())
        return time if time < span else np.inf

    def look_on(self, world: World, elapsed: float, rest: float) -> float:
        """Return what `next_look` does after a flight of ``elapsed`` seconds, with ``rest`` left of the substep.

        It is 0 where somebody is to be detected now. Who goes another way than was foreseen is looked after henceforth.
        """
        fast, motion = self._fast, world[Motion]
        if not len(fast.pairs):
            return np.inf
        fast.left[fast.asked] = self.left
        spend_trust(
            elapsed, self._span - (world[Progress].foreseen + rest), rest, fast.looked.bodies, fast.looked.numbers,
            fast.looked.roots, motion.linear, motion.angular, self._linear, self._angular, fast.asked, fast.left,
        )  # fmt: skip
        self._ask()
        return self.next_look(world, rest, found=False)

    def _times(
        self, world: World, of: Fast | FastPairs, center: Floats, span: float, *, found: bool, first_only: bool = False
    ) -> Floats:
        """Return when (n,) each pair is to be looked at again."""
        motion, times = world[Motion], np.empty(len(of.left))
        foresee_meetings(
            span, first_only, found, center, world[Transform].rotation, motion.linear, motion.angular,
            world[Flight].felt, *of.looked, *self.land, of.left, times,
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
