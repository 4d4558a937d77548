"""Recycling: the contacts of pairs that hardly move against each other go with their shapes."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.relations.contact import Contact
from carom.systems.detection.narrow import Found, measure_pairs
from carom.systems.kernels.recycling import merge_contacts, recycle_contacts


def measure_what_moved(world: World, pairs: Integers, reaches: Floats) -> Found:
    """Return the contact points of sorted ``pairs`` (n, 2), recycled where a pair has hardly moved since found."""
    recycled, stays = _recycled(world, pairs, reaches)
    if not len(recycled.row_a):
        return measure_pairs(world, pairs, reaches)
    moved = ~stays
    fresh = measure_pairs(world, pairs[moved], reaches[moved])
    source = np.empty(len(recycled.row_a) + len(fresh.row_a), np.int64)
    merge_contacts(recycled.row_a, recycled.row_b, len(recycled.row_a), fresh.row_a, fresh.row_b, source)
    return Found(*(np.concatenate([old, new[::-1]])[source] for old, new in zip(recycled, fresh, strict=True)))


def _recycled(world: World, pairs: Integers, reaches: Floats) -> tuple[Found, Booleans]:
    contact, collider, pose = world[Contact], world[Collider], world[ColliderPose]
    room = contact.count
    stays = np.zeros(len(pairs), np.bool_)
    found = Found(
        np.empty(room, np.int64), np.empty(room, np.int64), np.empty(room, np.int64),
        np.empty((room, 3)), np.empty(room), np.empty((room, 3)), np.empty(room, np.bool_), np.ones(room, np.bool_),
    )  # fmt: skip
    count = recycle_contacts(
        pairs, reaches, room, world.handles(), world.slots.row_shift,
        collider.shape, collider.size, collider.geometry, collider.bound_half, collider.bound_radius,
        pose.position, pose.rotation,
        contact.a, contact.b, contact.seat_a, contact.seat_b, contact.lean_a, contact.lean_b,
        contact.seat_depth, contact.form, contact.feature, contact.by_fcl,
        stays, found.row_a, found.row_b, found.feature, found.normal, found.depth, found.point, found.by_fcl,
    )  # fmt: skip
    return found.take(slice(count)), stays
