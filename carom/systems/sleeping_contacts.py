"""Contacts of those who sleep: out of the table that the step works on, and back into it."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, World
from carom.ecs.column import Booleans, Integers
from carom.ecs.entity import INDEX_MASK
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.systems.compound import bodies_of


def move_contacts(world: World, source: type[Contact], into: type[Contact], which: Booleans) -> None:
    """Move some rows of one contact table into another; both are in order of the rows of their colliders."""
    there, moving = world.count(into), int(which.sum())
    world.resize(into, there + moving)
    begin, end = world[source], world[into]
    for name in Contact.columns:
        getattr(end, name)[there : end.count] = getattr(begin, name)[: begin.count][which]
    drop_contacts(world, which, source)
    handles = end.a[: end.count], end.b[: end.count]
    ids = [of & INDEX_MASK for of in handles]
    row_a, row_b = (of + world.slots.row_shift[of] for of in ids)
    order = np.lexsort((row_b, row_a))
    for name in Contact.columns:
        column = getattr(end, name)
        column[: end.count] = column[order]


def drop_contacts(world: World, which: Booleans, source: type[Contact] = SleepingContact) -> None:
    """Take rows out of a contact table."""
    contact, count = world[source], len(which)
    kept = count - int(which.sum())
    for name in Contact.columns:
        column = getattr(contact, name)
        column[:kept] = column[:count][~which]
    world.resize(source, kept)


def left_alone(world: World) -> Integers:
    """Return the bodies that touched a collider that is no more, and forget that they did where nobody is left."""
    sleeping, present = world[SleepingContact], world.table(Collider).present
    handles = np.stack([sleeping.a[: sleeping.count], sleeping.b[: sleeping.count]], axis=1)
    there = world.slots.live(handles)
    there[there] = present[world.slots.rows(handles[there])]
    if there.all():
        return np.zeros(0, np.int64)
    bodies = np.stack([sleeping.body_a[: sleeping.count], sleeping.body_b[: sleeping.count]], axis=1)
    left: Integers = bodies[there & ~there.all(axis=1, keepdims=True) & (bodies >= 0)]
    alone = ~(there & (bodies >= 0)).any(axis=1)
    if alone.any():
        drop_contacts(world, np.asarray(alone))
    return left


def locate_contacts(world: World) -> None:
    """Find the rows of what sleeping contacts are of; who is no more has no body."""
    sleeping, bodies, slots = world[SleepingContact], bodies_of(world), world.slots
    now = slice(sleeping.count)
    for handles, rows, body in (
        (sleeping.a[now], sleeping.row_a[now], sleeping.body_a[now]),
        (sleeping.b[now], sleeping.row_b[now], sleeping.body_b[now]),
    ):
        there = slots.live(handles)
        rows[~there], body[~there] = 0, -1
        rows[there] = slots.rows(handles[there])
        body[there] = bodies[rows[there]]
