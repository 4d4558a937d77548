"""Broad phase: which colliders have bounds that overlap."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, Motion, RigidBody, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.components.flight import Flight
from carom.systems.awake import Awake
from carom.systems.constants import FEW_ASTRAY, FEW_BESIDE, MOST_ASTRAY
from carom.systems.detection.broad_index import Index
from carom.systems.kernels.broad_cache import (
    IS_SENSOR,
    REBUILD,
    are_those_met,
    find_leavers,
    find_met,
    keep_overlapping,
)
from carom.systems.kernels.broad_pairs import renew_pairs
from carom.systems.kernels.crew import threads_of
from carom.systems.kernels.islands import find_lively
from carom.systems.settings import Settings
from carom.systems.shapes.plane import Plane
from carom.systems.stream import Stream
from carom.systems.threads import crew_for

NOBODY: Integers = np.array([-1])
STAYS: Floats = np.zeros((2, 3))


def overlapping(world: World) -> Integers:
    """Return the pairs (n, 2) of collider rows whose bounds overlap, lower row first, sorted."""
    return still_overlapping(world, world[BroadPhase].renewed(world))


def still_overlapping(world: World, pairs: Integers) -> Integers:
    """Return which ``pairs`` (n, 2) of collider rows have bounds that overlap.

    One of a pair can be pushed, or is a sensor and one moves; each is on a layer that the other accepts, and they are
    of two bodies and not both sensors. Those of which nobody is awake are left out (`find_lively`).
    """
    if not len(pairs):
        return pairs
    collider, pose, motion = world[Collider], world[ColliderPose], world[Motion]
    found, meeting = np.empty((len(pairs), 2), np.int64), np.empty(len(pairs), np.bool_)
    lively: Booleans = np.empty(len(collider.shape), np.bool_)
    lively.fill(True)
    if len(world[Awake].sleepers):
        find_lively(
            world.row_numbers(Collider), pose.body_row, collider.sensor, pose.moved, motion.asleep,
            world[RigidBody].inverse_mass, motion.linear, motion.angular, lively,
        )  # fmt: skip
    crew = crew_for(world, len(pairs))
    counts = np.zeros(threads_of(crew), np.int64)
    keep_overlapping(
        crew, pairs, lively, collider.shape, collider.size, pose.body_row, world[Flight].reach, world[Stream].passes,
        pose.position, pose.rotation, pose.lower, pose.upper,
        meeting, counts, found,
    )  # fmt: skip
    return found[: sum(counts.tolist())]


class BroadPhase(Resource):
    """The pairs whose fat bounds overlap, found anew for those that left theirs; a cache, droppable at any time.

    Those that meet nobody, by their layer or mask, are looked up as little as if they were not there.

    Rows are compared with what they were when they were looked up, so nobody has to tell it of a change. Where all but
    a few go along in a `Stream`, fat bounds do so too, and only those few leave theirs.
    """

    def __init__(self) -> None:
        self.pairs: Integers = np.empty((0, 2), np.int64)
        self._make_room(0)
        self.drop()

    def drop(self) -> None:
        """Forget everything; the next detection finds the same pairs from nothing."""
        self.rows: Integers = NOBODY  # also a world without colliders is new
        self._flat, self._comes = NOBODY[:0], 0.0
        self.senses = False  # whether some may be sensors
        self._goes_along, self._set_out = False, np.zeros(3)
        self._watched: tuple[Integers, Integers, Integers] | None = None

    def watched(self, world: World) -> Integers:
        """Return the rows of bodies that are awake and may meet somebody, who are not to leave their reach unseen."""
        awake = world[Awake].now(world)
        if self.rows is NOBODY:
            return awake
        if self._watched is None or self._watched[0] is not awake or self._watched[1] is not self.rows:
            meets = np.zeros(world.used() + 1, np.bool_)
            meets[world[ColliderPose].body_row[self.rows]] = True
            meets[-1] = False  # what has no body
            found = awake[meets[awake]]
            self._watched = awake, self.rows, awake if len(found) == len(awake) else found
        return self._watched[2]

    def _make_room(self, used: int) -> None:
        self.fat_lower, self.fat_upper = np.zeros((used, 3)), np.zeros((used, 3))
        self.known = np.zeros((used, 4), np.int64)  # row of the body, layer, mask, flags
        self.seat = np.zeros((used, 11))  # of half spaces: position, rotation, size

    def renewed(self, world: World) -> Integers:
        """Return the pairs (n, 2) whose fat bounds overlap, sorted."""
        collider, there = world[Collider], world.row_numbers(Collider)
        if not are_those_met(there, collider.layer, collider.mask, self.rows):
            met: Integers = np.empty(len(there), np.int64)
            self.rows = met[: find_met(there, collider.layer, collider.mask, met)]
            if len(self.rows) and self.rows[-1] >= len(self.known):
                self._make_room(world.capacity)
            return self._found_anew(world)
        if self._half_spaces_come(world) > self._comes:
            return self._found_anew(world)
        leavers = self._leavers(world)
        astray = max(FEW_ASTRAY, MOST_ASTRAY * len(self.rows))
        if leavers is None or len(leavers) + len(self.index.strays) > astray:
            return self._found_anew(world)
        if len(leavers):
            self._replace(world, leavers)
        return self.pairs

    def _replace(self, world: World, leavers: Integers) -> None:
        """Look up only those that left their fat bounds."""
        self.senses |= self._have_sensors(leavers)
        self.index.lead_astray(leavers)
        new = self.index.pairs_of(world, leavers)
        pairs: Integers = np.empty((len(self.pairs) + len(new), 2), np.int64)
        self.pairs = pairs[: renew_pairs(self.pairs, new, leavers, len(self.known), pairs)]

    def _half_spaces_come(self, world: World) -> float:
        """Return how far (m) half spaces come within the step, as others see it."""
        if not len(self._flat):
            return 0.0
        bodies = world[ColliderPose].body_row[self._flat]
        return world[Stream].passes + float(np.where(bodies < 0, 0.0, world[Flight].reach[bodies]).max())

    def _found_anew(self, world: World) -> Integers:
        self._flat = self.rows[world[Collider].shape[self.rows] == Plane.number]
        self._goes_along, self._set_out = self._flows(world), world[Stream].gone.copy()
        self._leavers(world, anew=True)
        self.senses = self._have_sensors(self.rows)
        self._comes = 2.0 * self._half_spaces_come(world)  # so that it is not left at once
        self.index = Index(world, self.rows, self.fat_lower, self.fat_upper, self.known, self._comes)
        self.pairs = self.index.all_pairs(world)
        return self.pairs

    def _have_sensors(self, rows: Integers) -> bool:
        return bool((self.known[rows, 3] & IS_SENSOR).any())

    def _flows(self, world: World) -> bool:
        """Tell whether there is a stream that all but a few go along in, and no half space that comes on and on."""
        stream = world[Stream]
        if len(self._flat) or not (stream.motion[0].any() and np.isfinite(stream.gone).all()):
            return False
        body = world[ColliderPose].body_row[self.rows]
        return int(np.count_nonzero((body < 0) | world[Motion].asleep[body])) <= FEW_BESIDE

    def _frame(self, world: World) -> Floats:
        stream = world[Stream]
        return np.stack((stream.motion[0], stream.gone - self._set_out)) if self._goes_along else STAYS

    def _leavers(self, world: World, *, anew: bool = False) -> Integers | None:
        """Give those new fat bounds who need them and return their rows; None where everyone is to be found anew."""
        collider, pose = world[Collider], world[ColliderPose]
        leavers: Integers = np.empty(len(self.rows), np.int64)
        count = find_leavers(
            anew, self.rows, collider.shape, collider.size, collider.bound_half, collider.bound_radius, pose.body_row,
            world[RigidBody].inverse_mass, collider.layer, collider.mask, collider.sensor,
            pose.position, pose.rotation, pose.lower, pose.upper,
            world[Motion].linear, world[Motion].angular, world[Flight].reach, world[Settings].dt, self._frame(world),
            self.fat_lower, self.fat_upper, self.known, self.seat, leavers,
        )  # fmt: skip
        return None if count == REBUILD else leavers[:count]
