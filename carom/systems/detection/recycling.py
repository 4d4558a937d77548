"""Recycling: the contacts of pairs that hardly move against each other go with their shapes."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Floats, Integers
from carom.ecs.relations.contact import Contact
from carom.systems.detection.answered import Answered
from carom.systems.detection.apart import Apart
from carom.systems.detection.narrow import Found, measure_pairs
from carom.systems.kernels.crew import threads_of
from carom.systems.kernels.recycling import merge_contacts, recycle_contacts
from carom.systems.resting import Resting
from carom.systems.threads import crew_for


def measure_what_moved(world: World, pairs: Integers, reaches: Floats) -> Found:
    """Return the contact points of sorted ``pairs`` (n, 2), recycled where a pair has hardly moved since found."""
    contact, collider, pose = world[Contact], world[Collider], world[ColliderPose]
    moved, moved_reaches = np.empty_like(pairs), np.empty_like(reaches)
    recycled = Found.room(contact.count)
    crew = crew_for(world, len(pairs))
    ends = np.zeros((threads_of(crew), 2), np.int64)
    recycle_contacts(
        crew, pairs, reaches, world[Resting].knows(world), contact.count, world.handles(), world.slots.row_shift,
        collider.shape, collider.size, collider.geometry, collider.bound_half, collider.bound_radius,
        pose.position, pose.rotation,
        contact.a, contact.b, contact.seat_a, contact.seat_b, contact.lean_a, contact.lean_b,
        contact.seat_depth, contact.form, contact.feature, contact.by_fcl,
        moved, moved_reaches, *recycled, ends,
    )  # fmt: skip
    count, moving = map(max, zip(*ends.tolist(), strict=True))  # not all may have come
    world[Answered].recycled += len(pairs) - moving
    if count < contact.count:
        recycled = recycled.take(slice(count))
    if not moving:
        return recycled
    fresh = measure_pairs(world, moved[:moving], moved_reaches[:moving], apart=world[Apart])
    if not len(fresh.row_a):
        return recycled
    if not count:
        return fresh
    found = Found.room(count + len(fresh.row_a))
    merge_contacts(count, *recycled, *fresh, *found)
    return found
