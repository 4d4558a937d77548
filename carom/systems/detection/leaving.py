"""Leaving: bodies that come farther than detection foresaw, most of whom meet nobody new there."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, Motion, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.hierarchy import compose
from carom.ecs.relations.contact import Contact
from carom.systems.awake import Awake
from carom.systems.constants import MOST_WIDENED
from carom.systems.continuous import fast_of
from carom.systems.detection.bounds import bound, reaches_of
from carom.systems.detection.broad import BroadPhase, still_overlapping
from carom.systems.detection.narrow import Found, measure_pairs
from carom.systems.detection.seams import without_seams
from carom.systems.kernels.broad_pairs import pairs_of
from carom.systems.kernels.reach import find_leaving, find_ways, widen_reach
from carom.systems.passing import without_passing
from carom.systems.progress import Progress
from carom.systems.stream import Stream
from carom.systems.ties import Ties


def detection_holds(world: World, soon: float) -> bool:
    """Tell whether the contact table holds until the substep ends in ``soon`` seconds; bodies may get more reach by it.

    Who was struck goes another way than was foreseen, but most often meets nobody there who is not in the table: to
    know that costs a tenth of detecting all anew. As that, it is found out for the rest of the step at once. Who leaves
    later than this substep may be stopped before, as what rests is, whatever pulls at it: it is asked about then.
    """
    flight, motion, rows = world[Flight], world[Motion], world[BroadPhase].watched(world)
    if not len(rows):
        return True
    leaving: Integers = np.empty(MOST_WIDENED + 1, np.int64)
    count = find_leaving(
        rows, soon, world[Stream].motion, flight.center, flight.detected_center, flight.reach, motion.linear,
        flight.felt, leaving,
    )  # fmt: skip
    return count == 0 or (
        count <= MOST_WIDENED and _meet_nobody_new(world, leaving[:count], soon + world[Progress].foreseen)
    )


def _meet_nobody_new(world: World, leaving: Integers, left: float) -> bool:
    """Widen the reach of bodies (rows); tell whether all points at which they may meet others then are known."""
    flight, motion, pose = world[Flight], world[Motion], world[ColliderPose]
    leaves: Booleans = np.zeros(world.used() + 1, np.bool_)  # the last, -1, is that of what stands
    leaves[leaving] = True
    compose(world)
    stream = world[Stream]
    widen_reach(
        leaving, left, stream.motion, flight.center, motion.linear, flight.felt, flight.reach, flight.detected_center
    )
    colliders = world.row_numbers(Collider)
    own = colliders[leaves[pose.body_row[colliders]]]
    _bound_now(world, own, left, flight.reach)
    pairs = world[BroadPhase].renewed(world)
    theirs: Integers = np.empty_like(pairs)
    pairs = still_overlapping(world, theirs[: pairs_of(pairs, pose.body_row, leaves, theirs)])
    pairs = world[Ties].without_joined(world, pairs)
    # The others are measured where they are now, and reach as far from there as they did from where they were.
    colliders, ways = np.unique(pairs), np.zeros(len(flight.reach))
    find_ways(colliders, pose.body_row, stream.motion, flight.center, flight.detected_center, flight.reach, ways)
    _bound_now(world, colliders, left, ways)
    if len(fast_of(world, pairs, left, flight.center)[0]):
        return False
    found = measure_pairs(world, pairs, reaches_of(world, pairs, ways))
    found, _ = without_passing(world, found, left, flight.center, np.ones(len(flight.reach), np.bool_))
    return _are_known(world, without_seams(world, found))


def _bound_now(world: World, rows: Integers, left: float, reach: Floats) -> None:
    """Bound colliders (rows), told as where the stream has come from since detection, as all other bounds are."""
    pose, way = world[ColliderPose], world[Stream].motion[1]
    bound(world, rows, pose.body_row, left, reach, world[Flight].center)
    if way.any():
        taken: Booleans = np.zeros(world.used() + 1, np.bool_)
        taken[world[Awake].now(world)] = True
        rows = rows[taken[pose.body_row[rows]]]
        pose.lower[rows] -= way
        pose.upper[rows] -= way


def _are_known(world: World, found: Found) -> bool:
    """Tell whether the contact table has as many points of each pair as were found."""
    contact, scale = world[Contact], world.capacity
    known: Integers = contact.row_a[: contact.count] * scale + contact.row_b[: contact.count]
    pairs, counts = np.unique(found.row_a * scale + found.row_b, return_counts=True)
    first, last = np.searchsorted(known, pairs), np.searchsorted(known, pairs, side="right")
    return bool((counts <= last - first).all())
