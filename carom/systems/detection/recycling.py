"""Recycling: the contacts of pairs that hardly move against each other go with their shapes."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Floats, Integers
from carom.ecs.relations.contact import Contact
from carom.systems.detection.answered import Answered
from carom.systems.detection.apart import Apart
from carom.systems.detection.narrow import NOTHING, Found, measure_pairs
from carom.systems.kernels.crew import threads_of
from carom.systems.kernels.recycling import merge_contacts, recycle_contacts
from carom.systems.resting import Resting
from carom.systems.threads import crew_for


class Kept(Found):
    """All contacts of the table, in their places there."""

    __slots__ = ()


def measure_what_moved(world: World, pairs: Integers, reaches: Floats) -> Found:
    """Return the contact points of sorted ``pairs`` (n, 2), recycled where a pair has hardly moved since found.

    Those recycled are placed in the table; where all of it is, that is returned.
    """
    contact, collider, pose, resting = world[Contact], world[Collider], world[ColliderPose], world[Resting]
    known = resting.knows(world)
    if known and not resting.solids:  # balls roll, and are never recycled
        return measure_pairs(world, pairs, reaches, apart=world[Apart])
    moved, moved_reaches = np.empty_like(pairs), np.empty_like(reaches)
    kept: Integers = np.empty(contact.count, np.int64)
    crew = crew_for(world, len(pairs))
    ends = np.zeros((threads_of(crew), 2), np.int64)
    recycle_contacts(
        crew, pairs, reaches, known, contact.count, world.handles(), world.slots.row_shift,
        collider.shape, collider.size, collider.geometry, collider.bound_half, collider.bound_radius,
        pose.position, pose.rotation,
        contact.a, contact.b, contact.seat_a, contact.seat_b, contact.lean_a, contact.lean_b,
        contact.seat_depth, contact.form,
        moved, moved_reaches, contact.row_a, contact.row_b, contact.normal, contact.depth, contact.point, kept, ends,
    )  # fmt: skip
    count, moving = map(max, zip(*ends.tolist(), strict=True))  # not all may have come
    world[Answered].recycled += len(pairs) - moving
    table = Found(
        contact.row_a, contact.row_b, contact.feature, contact.normal, contact.depth, contact.point, contact.by_fcl,
        kept,
    )  # fmt: skip
    if not moving and count == contact.count:
        return Kept(*table.take(slice(count)))
    fresh = NOTHING
    if moving:
        fresh = measure_pairs(world, moved[:moving], moved_reaches[:moving], apart=world[Apart])
        if not count:
            return fresh
    found = Found.room(count + len(fresh.row_a))
    merge_contacts(kept[:count], *table[:-1], *fresh, *found)
    return found
