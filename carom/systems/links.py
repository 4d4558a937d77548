"""Links: which two bodies touch at rest or are joined, so that they fall asleep and wake together."""

from __future__ import annotations

import numpy as np

from carom.ecs import RigidBody, World
from carom.ecs.column import Booleans, Integers
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.systems.kernels.islands import find_islands
from carom.systems.ties import Ties


def joins_islands(contact: Contact) -> Booleans:
    """Tell which contacts (count,) join islands."""
    found: Booleans = contact.resting[: contact.count] | (contact.depth[: contact.count] >= 0.0)
    return found


def links(world: World, *kinds: type[Contact]) -> tuple[Integers, Integers]:
    """Return the bodies (n,), -1 for what stands, of each two that contacts of these tables or joints link."""
    ties = world[Ties].now(world)
    a, b = [ties.body_a], [ties.body_b]
    for kind in kinds:
        contact = world[kind]
        which = slice(contact.count) if kind is SleepingContact else np.nonzero(joins_islands(contact))[0]
        a.append(contact.body_a[which])
        b.append(contact.body_b[which])
    return np.concatenate(a), np.concatenate(b)


def nearby(world: World) -> tuple[Integers, Integers]:
    """Return the bodies (n,), -1 for what stands, of each two that are not linked but may touch within the step."""
    contact = world[Contact]
    which = np.nonzero(~joins_islands(contact))[0]
    return contact.body_a[which], contact.body_b[which]


def islands(world: World, rows: Integers, *kinds: type[Contact]) -> Integers:
    """Return for each row, of those among ``rows`` (bodies), the lowest row of its island; 0 for others."""
    return _joined(world, rows, *links(world, *kinds))


def companies(world: World) -> Integers:
    """Return for each row that is a body the lowest row of all islands near each other, who fall asleep together."""
    linked, near = links(world, Contact, SleepingContact), nearby(world)
    return _joined(world, world.row_numbers(RigidBody), *map(np.concatenate, zip(linked, near, strict=True)))


def _joined(world: World, rows: Integers, body_a: Integers, body_b: Integers) -> Integers:
    inverse_mass = world[RigidBody].inverse_mass
    island: Integers = np.zeros(len(inverse_mass), np.int64)
    find_islands(rows, body_a, body_b, inverse_mass, island)
    return island


def all_islands(world: World) -> Integers:
    """Return for each row that is a body the lowest row of its island, of those that sleep too."""
    return islands(world, world.row_numbers(RigidBody), Contact, SleepingContact)
