"""Continuous: bodies that are fast for their size are looked after on their way, so that they pass through nobody."""

from __future__ import annotations

import numpy as np

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
from carom.systems.kernels.left_out import when_near, write_left_out
from carom.systems.kernels.meeting import foresee_meetings
from carom.systems.kernels.swinging import NUMBERS
from carom.systems.kernels.telling import ask_told
from carom.systems.kernels.told import renew_told, write_told
from carom.systems.kernels.trust import ask_straying, find_agreeing, find_trusts, spend_trust
from carom.systems.looked import NO_PAIRS, NONE_LEFT_OUT, NONE_TOLD, NOWHERE, FastPairs, Land, LeftOut, Looked, Told
from carom.systems.progress import Progress
from carom.systems.resting import Resting
from carom.systems.settings import Settings


class Fast(Resource):
    """All pairs that are fast, and the land they fly over.

    ``trusts`` (rows, 10) say of each body how far (m) its contacts are trusted, infinity for most, and what bounds how
    fast it comes to somebody (`find_trusts`).
    """

    def __init__(self) -> None:
        self.all, self.land, self.left_out, self.told = NO_PAIRS, NOWHERE, NONE_LEFT_OUT, NONE_TOLD
        self._times: Floats = np.empty(0)  # when each pair is to be looked at, by the last look
        self.trusts: Floats = np.zeros((0, 10))
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
        self.all, self.left_out = NO_PAIRS, NONE_LEFT_OUT
        if not (len(fast) or len(free)):  # most often
            return
        if len(free):
            free, free_numbers = fast_of(world, free, span, center, free=True)
            fast, numbers = np.concatenate([fast, free]), np.concatenate([numbers, free_numbers])
            order = np.lexsort(fast.T[::-1])
            fast, numbers = fast[order], numbers[order]
        self.all = FastPairs.of(fast, Looked.room(numbers), motion.linear)
        given, reaches = fast.copy(), numbers.copy()
        self.land, self._limited = look_at(world, fast, center, self.all.looked), True
        find_trusts(self.all.looked.bodies, numbers, motion.linear, motion.angular, self.trusts)
        times, agrees = self._foresee(world, center, span, found=True), np.empty(len(fast), np.bool_)
        find_agreeing(
            given, reaches, times, span, found.row_a, found.row_b, found.normal, found.depth, found.point,
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

    def tells(self, world: World, span: float) -> bool:
        """Tell whether all who are to be looked at now meet where contacts in the table tell, and write how these are.

        Then nobody needs to be detected anew: they are trusted again, within ``span`` seconds, and may strike again.
        """
        of, contact, motion, tells = self.all, world[Contact], world[Motion], np.empty(len(self.all.pairs), np.bool_)
        center, rotation = world[Flight].center, world[Transform].rotation
        of_contacts = contact.body_a, contact.body_b, contact.normal
        if not ask_told(
            span, center, rotation, motion.linear, motion.angular, accelerations(world), *of.looked, *self.land,
            of.asked, self._times, *of_contacts, *self.told, of.left, tells,
        ):  # fmt: skip
            return False
        collider, resting = world[Collider], world[Resting]
        resting.sink(world)
        renew_told(
            resting.count, resting.start, resting.group_of, resting.lane_of, resting.row, resting.stale,
            contact.row_a, contact.row_b, collider.shape, collider.bound_radius, *of_contacts, *self.told, tells,
            center, rotation, motion.linear, motion.angular, contact.depth, contact.offset_a, contact.offset_b,
            contact.resting, resting.lanes,
        )  # fmt: skip
        return True

    def let_go(self, contact: Contact) -> None:
        """Let contacts strike again of pairs of which one is new, or that are looked after: they may turn onto one."""
        let_go(self.pairs, contact.count, contact.row_a, contact.row_b, contact.resting)

    def next_look(self, world: World, span: float, *, found: bool) -> float:
        """Return in how many seconds somebody is to be detected anew as all move now; infinity beyond ``span``.

        Contacts have just been ``found``, or what was is trusted for as long as it lasts.
        """
        if found and len(self.all.pairs):  # planes of contacts stay where they go at another speed
            settings = world[Settings]
            gone = world[Progress].substep * (settings.dt / settings.substeps)
            self._ask_straying(world, gone, world[Motion].linear)
        if not self.all.asked.any():
            return np.inf
        center, motion = world[Flight].center, world[Motion]
        first = float(self._foresee(world, center, span, found=found, first_only=True).min())
        near = when_near(span, *self.left_out, center, world[Transform].rotation, motion.linear, motion.angular)
        time = min(first, near)
        return time if time < span else np.inf

    def look_on(self, world: World, elapsed: float, rest: float) -> float:
        """Return what `next_look` does after a flight of ``elapsed`` seconds, with ``rest`` left of the substep.

        It is 0 where somebody is to be detected now.
        """
        of, motion = self.all, world[Motion]
        if len(of.pairs):
            spend_trust(
                elapsed, of.looked.bodies, of.looked.numbers, world[Transform].rotation, motion.linear, motion.angular,
                of.linear, of.left,
            )  # fmt: skip
            self._ask_straying(world, rest, of.linear)
        return self.next_look(world, rest, found=False)

    def _ask_straying(self, world: World, time: float, before: Floats) -> None:
        """Look after those who go another way within a time (s) than was foreseen, as velocities were ``before``."""
        of, motion = self.all, world[Motion]
        ask_straying(
            time, of.looked.bodies, of.looked.numbers, world[Transform].rotation, motion.linear, motion.angular,
            before, of.asked,
        )  # fmt: skip

    def _foresee(self, world: World, center: Floats, span: float, *, found: bool, first_only: bool = False) -> Floats:
        """Return when (n,) each pair is to be looked at again."""
        motion, flight, of = world[Motion], world[Flight], self.all
        times = self._times = np.empty(len(of.pairs))
        foresee_meetings(
            span, first_only, found, center, world[Transform].rotation, motion.linear, motion.angular,
            accelerations(world), flight.detected_center, flight.detected_rotation, flight.reach,
            *of.looked, *self.land, of.asked, of.near, of.left, times,
        )  # fmt: skip
        return times


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
