"""Touching: which pairs of colliders begin to touch, still do, and end; and which struck each other audibly."""

from __future__ import annotations

import numpy as np

from carom.ecs import ColliderPose, Material, Motion, World, system
from carom.ecs.column import Integers
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.hit import Hit
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.touching import ContactBegin, ContactEnd, Touching
from carom.systems.awake import Awake, stirs
from carom.systems.kernels.touching import find_hits, renew_touching, write_touching
from carom.systems.settings import Settings, time_of


@system(
    reads=(Contact, Impact, ColliderPose, Motion, Settings, Awake),
    writes=(Touching, ContactBegin, ContactEnd),
    when=stirs,
)
def tell_contacts(world: World, dt: float) -> None:
    """Tell which pairs begin and end to touch."""
    contact, touching, impact = world[Contact], world[Touching], world[Impact]
    count, room = touching.count, touching.count + contact.count + impact.count
    if not room:
        return
    a, b, since = np.empty(room, np.int64), np.empty(room, np.int64), np.empty(room)
    begins, ends = np.empty(room, np.bool_), np.empty(count, np.bool_)
    found, new = renew_touching(
        contact.count, contact.a, contact.b, contact.row_a, contact.row_b, contact.impulse, contact.depth,
        impact.count, impact.a, impact.b, impact.time, np.empty(impact.count, np.int64),
        np.empty(impact.count, np.int64), np.empty(impact.count), time_of(world),
        count, touching.a, touching.b, touching.since, world.handles(), world.slots.row_shift,
        world[ColliderPose].body_row, world[Motion].asleep,
        a, b, since, begins, ends,
    )  # fmt: skip
    if found == count and not new:  # as most often; then it is what it was
        return
    world.resize(ContactEnd, count - (found - new))
    world.resize(ContactBegin, new)
    world.resize(Touching, found)
    end, begin, touching = world[ContactEnd], world[ContactBegin], world[Touching]
    write_touching(
        count, ends, (world.frame - 1) * world[Settings].dt, end.time, end.a, end.b,
        found, a, b, since, begins, begin.time, begin.a, begin.b, touching.a, touching.b, touching.since,
    )  # fmt: skip


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
