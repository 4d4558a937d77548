"""Recycling: the contacts of pairs that hardly move against each other go with their shapes."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.relations.contact import Contact
from carom.systems.detection.answered import Answered
from carom.systems.detection.narrow import Found, measure_pairs
from carom.systems.kernels.recycling import merge_contacts, recycle_contacts


def measure_what_moved(world: World, pairs: Integers, reaches: Floats) -> Found:
    """Return the contact points of sorted ``pairs`` (n, 2), recycled where a pair has hardly moved since found."""
    if not len(pairs):
        return Found.room(0)
    recycled, stays = _recycled(world, pairs, reaches)
    count = len(recycled.row_a)
    if not count:
        return measure_pairs(world, pairs, reaches)
    staying = int(np.count_nonzero(stays))
    world[Answered].recycled += staying
    if staying == len(pairs):
        return recycled
    moved = ~stays
    fresh = measure_pairs(world, pairs[moved], reaches[moved])
    found = Found.room(count + len(fresh.row_a))
    merge_contacts(count, *recycled[:-1], *fresh[:-1], *found)
    return found


def _recycled(world: World, pairs: Integers, reaches: Floats) -> tuple[Found, Booleans]:
    contact, collider, pose = world[Contact], world[Collider], world[ColliderPose]
    room = contact.count
    stays = np.zeros(len(pairs), np.bool_)
    found = Found.room(room)
    found.recycled[:] = True
    count = recycle_contacts(
        pairs, reaches, room, world.handles(), world.slots.row_shift,
        collider.shape, collider.size, collider.geometry, collider.bound_half, collider.bound_radius,
        pose.position, pose.rotation,
        contact.a, contact.b, contact.seat_a, contact.seat_b, contact.lean_a, contact.lean_b,
        contact.seat_depth, contact.form, contact.feature, contact.by_fcl,
        stays, found.row_a, found.row_b, found.feature, found.normal, found.depth, found.point, found.by_fcl,
    )  # fmt: skip
    return found.take(slice(count)), stays
