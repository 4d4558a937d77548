"""Touching: which pairs of colliders begin to touch, still do, and end; and which struck each other audibly."""

from __future__ import annotations

import numpy as np

from carom.ecs import ColliderPose, Material, Motion, World, system
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.hit import Hit
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.touching import ContactBegin, ContactEnd, Touching
from carom.systems.awake import Awake, stirs
from carom.systems.kernels.touching import find_hits, find_struck, renew_touching, write_events
from carom.systems.settings import Settings, time_of


@system(
    reads=(Contact, Impact, ColliderPose, Motion, Settings, Awake),
    writes=(Touching, ContactBegin, ContactEnd),
    when=stirs,
)
def tell_contacts(world: World, dt: float) -> None:
    """Tell which pairs begin and end to touch."""
    contact, touching = world[Contact], world[Touching]
    if not (contact.count or touching.count or world[Impact].count):
        return
    struck_a, struck_b, struck_at = struck(world)
    count, room = touching.count, touching.count + contact.count + len(struck_a)
    a, b, since = np.empty(room, np.int64), np.empty(room, np.int64), np.empty(room)
    begins, ends = np.empty(room, np.bool_), np.empty(count, np.bool_)
    found, new = renew_touching(
        contact.count, contact.a, contact.b, contact.row_a, contact.row_b, contact.impulse, contact.depth,
        struck_a, struck_b, struck_at, time_of(world),
        count, touching.a, touching.b, touching.since, world.handles(), world.slots.row_shift,
        world[ColliderPose].body_row, world[Motion].asleep,
        a, b, since, begins, ends,
    )  # fmt: skip
    if found == count and not new:  # as most often; then it is what it was
        return
    if found - new < count:
        began = np.full(count, (world.frame - 1) * world[Settings].dt)
        tell(world, ContactEnd, count - (found - new), ends, began, touching.a, touching.b)
    if new:
        tell(world, ContactBegin, new, begins[:found], since, a, b)
    world.resize(Touching, found)
    touching = world[Touching]
    touching.a[:found], touching.b[:found], touching.since[:found] = a[:found], b[:found], since[:found]


def struck(world: World) -> tuple[Integers, Integers, Floats]:
    """Return the pairs (rows) of living entities that were struck in the step, in order of rows, and when first (s)."""
    impact = world[Impact]
    if not impact.count:
        return impact.a[:0], impact.b[:0], impact.time[:0]
    a, b, at = np.empty(impact.count, np.int64), np.empty(impact.count, np.int64), np.empty(impact.count)
    count = find_struck(impact.count, impact.a, impact.b, impact.time, world.handles(), world.slots.row_shift, a, b, at)
    return a[:count], b[:count], at[:count]


def tell(
    world: World,
    kind: type[ContactBegin] | type[ContactEnd],
    count: int,
    which: Booleans,
    time: Floats,
    a: Integers,
    b: Integers,
) -> None:
    """Write a table of events, so many of ``which``, in order of time, then handles."""
    world.resize(kind, count)
    table = world[kind]
    write_events(which, time, a, b, table.time, table.a, table.b)


@system(reads=(Impact, Material, Settings, Awake), writes=(Hit,), when=stirs)
def tell_hits(world: World, dt: float) -> None:
    """Tell which impacts were fast enough to be heard, and of which materials."""
    impact = world[Impact]
    if not impact.count:
        return
    world.resize(Hit, impact.count)
    hit = world[Hit]
    count = find_hits(
        impact.count, world[Settings].hit_speed, world.handles(), world.slots.row_shift, world[Material].number,
        impact.time, impact.a, impact.b, impact.point, impact.normal, impact.speed, impact.impulse, impact.work,
        impact.friction_impulse,
        hit.time, hit.a, hit.b, hit.point, hit.normal, hit.speed, hit.impulse, hit.work, hit.friction_impulse,
        hit.material_a, hit.material_b,
    )  # fmt: skip
    world.resize(Hit, count)


def touching_rows(contact: Contact) -> Integers:
    """Return the rows of a table of contacts that touch; the others only may within a step."""
    live = slice(0, contact.count)
    return np.asarray(np.nonzero((contact.depth[live] >= 0.0) | (contact.impulse[live] > 0.0))[0], np.int64)
