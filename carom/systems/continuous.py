"""Continuous: bodies that are fast for their size are looked after on their way, so that they pass through nobody."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs import Collider, ColliderPose, Motion, RigidBody, Transform, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.meshes import PackedMeshes
from carom.systems.detection.narrow import Found
from carom.systems.kernels.fast_pairs import (
    TRIANGLE_CORNERS,
    find_far,
    find_fast,
    find_quick,
    let_go,
    place_fast,
    take_quick,
)
from carom.systems.kernels.left_out import write_left_out
from carom.systems.kernels.meeting import foresee_meetings
from carom.systems.kernels.swinging import NUMBERS
from carom.systems.kernels.told import tell_let_go, write_told
from carom.systems.kernels.trust import find_agreeing, find_trusts
from carom.systems.looked import NO_PAIRS, NONE_LEFT_OUT, NONE_TOLD, NOWHERE, FastPairs, Land, LeftOut, Looked, Told
from carom.systems.progress import Progress


class Fast(Resource):
    """All pairs that are fast, and the land they fly over.

    ``trusts`` (rows, 10) say of each body how far (m) its contacts are trusted, infinity for most, and what bounds how
    fast it comes to somebody (`find_trusts`); ``struck`` (rows,), who was since the last look.
    """

    def __init__(self) -> None:
        self.all, self.land, self.left_out, self.told = NO_PAIRS, NOWHERE, NONE_LEFT_OUT, NONE_TOLD
        self.trusts: Floats = np.zeros((0, 10))
        self.struck: Booleans = np.zeros(0, np.bool_)
        self._limited = False  # whether some of them are finite

    @property
    def pairs(self) -> Integers:
        """The pairs (n, 2) of collider rows that are looked after, a mesh first."""
        return self.all.pairs[self.all.asked]

    def find(self, world: World, fast: Integers, numbers: Floats, free: Integers, found: Found, span: float) -> None:
        """Find who of ``fast`` pairs (n, 2) is to be looked after for ``span`` seconds, by what is ``found`` of them.

        They come with their ``numbers``. So are pairs of two that are ``free`` (m, 2), which `without_passing` tells.
        """
        pose, motion, center = world[ColliderPose], world[Motion], world[Flight].detected_center
        size = len(motion.asleep)
        if self._limited or len(self.trusts) != size:
            self.trusts, self._limited = np.tile([np.inf, *np.zeros(9)], (size, 1)), False
            self.struck = np.zeros(size, np.bool_)
        self.all, self.left_out = NO_PAIRS, NONE_LEFT_OUT
        if not (len(fast) or len(free)):  # most often
            return
        if len(free):
            free, free_numbers = fast_of(world, free, span, center, free=True)
            fast, numbers = np.concatenate([fast, free]), np.concatenate([numbers, free_numbers])
            order = np.lexsort(fast.T[::-1])
            fast, numbers = fast[order], numbers[order]
        self.all = FastPairs.of(fast, Looked.room(numbers), motion.linear, motion.angular)
        given, reaches = fast.copy(), numbers.copy()
        self.land, self._limited = look_at(world, fast, center, self.all.looked), True
        find_trusts(self.all.looked.bodies, numbers, motion.linear, motion.angular, self.trusts)
        flight, of, agrees = world[Flight], self.all, np.empty(len(fast), np.bool_)
        foresee_meetings(
            span, False, True, center, world[Transform].rotation, motion.linear, motion.angular, accelerations(world),
            flight.detected_center, flight.detected_rotation, flight.reach,
            *of.looked, *self.land, of.asked, of.near, of.left, of.times,
        )  # fmt: skip
        find_agreeing(
            given, reaches, self.all.times, span, found.row_a, found.row_b, found.normal, found.depth, found.point,
            pose.body_row, world[Flight].reach, center, motion.linear, motion.angular, agrees,
        )  # fmt: skip
        self.all.asked[:], self.all.left[agrees] = ~agrees, 0.0

    def trusted(self, world: World, found: Found) -> Found:
        """Return what is found, but of pairs that are looked after only what is near: the rest is found on the way."""
        if not len(self.all.pairs):
            return found
        pairs = self.pairs
        far, numbers = np.empty(len(found.row_a), np.bool_), self.all.looked.numbers[self.all.asked]
        number = find_far(pairs, numbers, found.row_a, found.row_b, found.depth, far)
        near = self.all.near[self.all.asked]
        if number and near.any():
            pairs, numbers, of_near = pairs[near], numbers[near], np.empty_like(far)
            left_out = find_far(pairs, numbers, found.row_a, found.row_b, found.depth, of_near)
            self.left_out = LeftOut.room(left_out)
            write_left_out(
                pairs, numbers, of_near, found.row_a, found.row_b, found.normal, found.depth, found.point,
                world[ColliderPose].body_row, world[Flight].detected_center, world[Transform].rotation, *self.left_out,
            )  # fmt: skip
        return found.without(far, number)

    def note(self, world: World) -> None:
        """Note where on their bodies the contacts in the table are."""
        self.told = NONE_TOLD
        if not len(self.all.pairs):
            return
        contact = world[Contact]
        self.told = Told.room(len(self.all.pairs), contact.count)
        write_told(
            self.all.pairs, contact.count, contact.kind, contact.row_a, contact.row_b, contact.body_a, contact.body_b,
            contact.normal, contact.depth, contact.point, world[Collider].bound_radius, world[Flight].detected_center,
            world[Transform].rotation, *self.told,
        )  # fmt: skip

    def tell_let_go(self, world: World) -> None:
        """Write into the table how far apart bodies are where contacts were let go on the way."""
        contact, center = world[Contact], world[Flight].center
        if len(self.told.spans):
            tell_let_go(
                self.told.spans, contact.body_a, contact.body_b, contact.normal, self.told.around, self.told.places,
                center, world[Transform].rotation, np.zeros_like(center), contact.depth,
            )  # fmt: skip

    def let_go(self, contact: Contact) -> None:
        """Let contacts strike again of pairs of which one is new, or that are looked after: they may turn onto one."""
        let_go(self.pairs, contact.count, contact.row_a, contact.row_b, contact.resting)

    @property
    def columns(self) -> tuple[npt.NDArray[Any], ...]:
        """What `fly_on` takes of those who are fast."""
        of = self.all
        return (
            *of.looked, *self.land, of.asked, of.near, of.left, of.times, of.linear, of.angular, *self.told,
            *self.left_out, self.trusts, self.struck,
        )  # fmt: skip


def accelerations(world: World) -> Floats:
    """Return by how much forces accelerate bodies (rows, 3); before a step knows them, those of the last substep.

    What they felt then is not what snapshots hold.
    """
    return world[Flight].felt if world[Progress].substep else world[Motion].linear_acceleration


def look_at(world: World, fast: Integers, center: Floats, looked: Looked) -> Land:
    """Write what is ``looked`` at of pairs (n, 2), bodies at their ``center``; return the land they fly over."""
    collider, pose = world[Collider], world[ColliderPose]
    hulls, meshes = world[PackedHulls].holding(world), world[PackedMeshes].holding(world)
    place_fast(
        fast, collider.shape, collider.size, collider.geometry, pose.body_row, pose.position, pose.rotation,
        center, world[Transform].rotation, world[Motion].angular, hulls, meshes.root, *looked,
    )  # fmt: skip
    room = np.concatenate([hulls.vertices, np.zeros((TRIANGLE_CORNERS, 3))])
    return Land(meshes.bounds, meshes.nodes, meshes.triangles, room)


def quick_ones(world: World, pairs: Integers, span: float, center: Floats) -> Booleans:
    """Tell of each body (row) whether one of ``pairs`` (n, 2) may be fast, as `fast_of` says, for it moves quickly.

    They are those that can meet within the ``span``. There are no rows where nobody does, as in most crowds. Of fewer
    pairs than colliders it takes as long to ask them, so that everybody may.
    """
    collider, pose, motion, rows = world[Collider], world[ColliderPose], world[Motion], world.row_numbers(Collider)
    if len(pairs) < len(rows):
        return np.ones(len(motion.asleep) if len(pairs) else 0, np.bool_)
    quick: Booleans = np.zeros(len(motion.asleep), np.bool_)
    some = find_quick(
        span, rows, collider.position, collider.bound_center, collider.bound_half,
        collider.bound_radius, pose.position, pose.body_row, center, world[RigidBody].inverse_mass,
        motion.linear, motion.angular, quick,
    )  # fmt: skip
    return quick if some else quick[:0]


def of_quick(world: World, pairs: Integers, quick: Booleans) -> Integers:
    """Return those of ``pairs`` (n, 2) of collider rows of which a body is ``quick``, or none where nobody is."""
    if not len(quick):
        return pairs[:0]
    found: Integers = np.empty((len(pairs), 2), np.int64)
    return found[: take_quick(pairs, world[ColliderPose].body_row, quick, found)]


def fast_of(
    world: World, pairs: Integers, span: float, center: Floats, *, free: bool = False
) -> tuple[Integers, Floats]:
    """Return who of ``pairs`` (n, 2) is fast enough within ``span`` seconds to be looked after, and their numbers.

    They are of a body and what nothing moves, or of one that is continuous; those of others if they are to be ``free``.
    Colliders and the centres of bodies, at ``center``, are where they are at one time.
    """
    fast, numbers = np.empty_like(pairs), np.empty((len(pairs), NUMBERS))
    if not len(pairs):
        return fast, numbers
    collider, pose, motion, body = world[Collider], world[ColliderPose], world[Motion], world[RigidBody]
    count = find_fast(
        pairs, free, span, collider.shape, collider.size, collider.position, collider.bound_center,
        collider.bound_half, collider.bound_radius, pose.position, pose.rotation, pose.body_row, center,
        body.inverse_mass, body.continuous, motion.linear, motion.angular, fast, numbers,
    )  # fmt: skip
    return fast[:count], numbers[:count]
