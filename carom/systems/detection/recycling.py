"""Recycling: the contacts of pairs that hardly move against each other go with their shapes."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, RigidBody, Transform, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems.detection.answered import Answered
from carom.systems.detection.apart import Apart
from carom.systems.detection.narrow import NOTHING, Found, measure_pairs
from carom.systems.kernels.balls_narrow import find_ball_contacts
from carom.systems.kernels.crew import threads_of
from carom.systems.kernels.merging import merge_contacts
from carom.systems.kernels.recycling import recycle_contacts
from carom.systems.passing import without_turning_past
from carom.systems.resting import Resting
from carom.systems.settings import Settings
from carom.systems.threads import crew_for

NO_GAPS: Floats = np.empty(0)


class Kept(Found):
    """All contacts of the table, in their places there."""

    __slots__ = ()


class Complete(Kept):
    """All contacts of the table, of which it holds also what follows from where their colliders are."""

    __slots__ = ()


def in_table(contact: Contact) -> tuple[Integers, Integers, Integers, Floats, Floats, Floats, Booleans]:
    """Return the columns of the contact table of what is found."""
    return (
        contact.row_a, contact.row_b, contact.feature, contact.normal, contact.depth, contact.point, contact.by_fcl
    )  # fmt: skip


def all_of(contact: Contact, places: Integers, *, complete: bool) -> Kept:
    """Return all contacts of the table; ``places`` (n,) are those that they have there."""
    return (Complete if complete else Kept)(*Found(*in_table(contact), places).take(slice(contact.count)))


def measure_what_moved(world: World, pairs: Integers, reaches: Floats, turning_for: float = 0.0) -> Found:
    """Return the contact points of sorted ``pairs`` (n, 2), recycled where a pair has hardly moved since found.

    Those recycled are placed in the table; where all of it is, that is returned. Where pairs reach as far as some turn,
    those that they only turn past within so many seconds are left out.
    """
    contact, collider, pose, resting = world[Contact], world[Collider], world[ColliderPose], world[Resting]
    known = resting.knows(world)
    if known and not resting.solids and world[Settings].collision == "auto":
        found = find_balls(world, pairs, reaches)
        if found is not None:
            return without_turning_past(world, found, turning_for)
    moved, moved_reaches = np.empty_like(pairs), np.empty_like(reaches)
    kept: Integers = np.empty(contact.count, np.int64)
    crew = crew_for(world, len(pairs))
    ends = np.zeros((threads_of(crew), 2), np.int64)
    recycle_contacts(
        crew, pairs, reaches, known, contact.count, world.handles(), world.slots.row_shift,
        collider.shape, collider.size, collider.geometry, collider.bound_half, collider.bound_radius,
        pose.position, pose.rotation, pose.body_row, world[Flight].detected_center,
        contact.a, contact.b, contact.seat_a, contact.seat_b, contact.lean_a, contact.lean_b,
        contact.seat_depth, contact.seat_reach, contact.form,
        moved, moved_reaches, contact.row_a, contact.row_b, contact.normal, contact.depth, contact.point,
        contact.offset_a, contact.offset_b, contact.share, kept, ends,
    )  # fmt: skip
    count, moving = map(max, zip(*ends.tolist(), strict=True))  # not all may have come
    world[Answered].recycled += len(pairs) - moving
    if not moving and count == contact.count:
        return all_of(contact, kept, complete=known and not resting.belts)
    fresh = NOTHING
    if moving:
        fresh = measure_pairs(world, moved[:moving], moved_reaches[:moving], apart=world[Apart])
        fresh = without_turning_past(world, fresh, turning_for)
        if not count:
            return fresh
    found = Found.room(count + len(fresh.row_a))
    merge_contacts(crew_for(world, len(found.row_a)), kept[:count], *in_table(contact), *fresh, *found)
    return found


def find_balls(world: World, pairs: Integers, reaches: Floats) -> Found | None:
    """Return the contact points of sorted ``pairs`` (n, 2), if all are such as `measure_balls` is for, else None.

    Where the table holds the same, they are placed in it. None also where a point is unsound, for others to say so.
    """
    contact, collider, pose = world[Contact], world[Collider], world[ColliderPose]
    crew, n = crew_for(world, len(pairs)), len(pairs)
    told, found = np.zeros((threads_of(crew), 3), np.int64), Found.room(n)
    find_ball_contacts(
        crew, pairs, reaches, collider.shape, collider.size, pose.position, pose.rotation, pose.body_row,
        world[Flight].detected_center, world[Transform].rotation, world[RigidBody].inverse_mass,
        world.handles(), world.slots.row_shift, contact.count, contact.a, contact.b, contact.kind, *in_table(contact),
        contact.offset_a, contact.offset_b, contact.share,
        np.empty(n, np.int64), np.empty(n, np.int64), np.empty((n, 7)), told, *found,
    )  # fmt: skip
    count, others, new = map(sum, zip(*told.tolist(), strict=True))
    if others:
        return None
    world[Answered].kernels += n
    world[Apart].note(world, pairs, NO_GAPS, 0)
    if new:
        return found.take(slice(count))
    return all_of(contact, found.old, complete=not world[Resting].belts)
