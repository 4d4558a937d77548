"""Broad and narrow phase: from bounds to the contact table."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from carom.ecs import Collider, ColliderPose, Material, Motion, RigidBody, Transform, World, system
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.commands import Commands
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.enter import Enter, Inside
from carom.systems.detection.answered import Answered
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.fcl_pairs import FclObjects, measure_by_fcl
from carom.systems.detection.sensors import sense
from carom.systems.kernels.broad import sweep_bounds
from carom.systems.kernels.contacts import complete_contacts, renew_contacts
from carom.systems.kernels.narrow import measure_balls, reach_of_pairs
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.plane import Plane


class Found(NamedTuple):
    """Contact points in order of (row a, row b, feature)."""

    row_a: Integers
    row_b: Integers
    feature: Integers
    normal: Floats
    depth: Floats
    point: Floats
    by_fcl: Booleans

    def take(self, which: Any) -> Found:
        """Return some of the contacts, by mask or by order."""
        return Found(*(column[which] for column in self))


@system(
    reads=(Transform, Motion, RigidBody, Collider, Material, Settings, Geometries),
    writes=(ColliderPose, Contact, Enter, Inside, Answered, Flight, FclObjects, Commands),
)
def find_contacts(world: World, dt: float) -> None:
    """Fill the contact table with every pair that touches or may touch within the step; tell who entered sensors."""
    contact = world[Contact]
    contact.impulse[: contact.count] = 0.0
    contact.friction_impulse[: contact.count] = 0.0
    detect(world)


def detect_again(world: World, left: float) -> None:
    """Detect anew in the middle of a step with ``left`` seconds to go, keeping what the step has summed so far."""
    reach_within(world, left)
    detect(world)


def detect(world: World) -> None:
    """Replace the contact table by one for the current poses, carrying over what known contacts hold."""
    world[Answered].detections += 1
    found = measure_pairs(world)
    found = sense(world, found)
    store(world, found)


def measure_pairs(world: World) -> Found:
    """Return the contact points of all pairs whose bounds overlap: by kernels where one stands in, else by FCL."""
    pairs = overlapping(world)
    reaches = np.empty(len(pairs))
    reach_of_pairs(pairs, world[ColliderPose].body_row, world[Flight].reach, reaches)
    answered = world[Answered]
    if world[Settings].collision == "fcl":
        answered.fcl += len(pairs)
        return measure_by_fcl(world, pairs, reaches)
    by_kernel, closed = measure_closed(world, pairs, reaches)
    if by_kernel.all():
        return closed
    others = ~by_kernel
    answered.fcl += int(np.count_nonzero(others))
    measured = measure_by_fcl(world, pairs[others], reaches[others])
    joined = Found(*(np.concatenate(columns) for columns in zip(closed, measured, strict=True)))
    return joined.take(np.lexsort((joined.feature, joined.row_b, joined.row_a)))


def measure_closed(world: World, pairs: Integers, reaches: Floats) -> tuple[Booleans, Found]:
    """Return which pairs have a closed form, and the contacts of those."""
    collider, pose = world[Collider], world[ColliderPose]
    n = len(pairs)
    by_kernel = np.empty(n, np.bool_)
    a, b, depth = np.empty(n, np.int64), np.empty(n, np.int64), np.empty(n)
    normal, point = np.empty((n, 3)), np.empty((n, 3))
    answers, count = measure_balls(
        pairs, reaches, collider.shape, collider.size, pose.position, pose.rotation,
        by_kernel, a, b, normal, depth, point,
    )  # fmt: skip
    world[Answered].kernels += answers
    none = np.zeros(count, np.int64)
    return by_kernel, Found(a[:count], b[:count], none, normal[:count], depth[:count], point[:count], none != 0)


def overlapping(world: World) -> Integers:
    """Return the pairs (n, 2) of collider rows whose bounds overlap, sorted."""
    collider, pose = world[Collider], world[ColliderPose]
    rows = world.row_numbers(Collider)
    flat = collider.shape[rows] == Plane.number
    finite = rows[~flat]
    finite = finite[np.argsort(pose.lower[finite, 0], kind="stable")]
    found: Integers = np.empty((8 * len(rows), 2), np.int64)
    while True:
        count = sweep_bounds(
            finite, rows[flat], collider.size, pose.lower, pose.upper, pose.body_row,
            collider.layer, collider.mask, collider.sensor, pose.position, pose.rotation, found,
        )  # fmt: skip
        if count <= len(found):
            break
        found = np.empty((count, 2), np.int64)
    return found[np.argsort(found[:count, 0] * world.capacity + found[:count, 1])]


def store(world: World, found: Found) -> None:
    """Write the contact table, matched with the one before."""
    old_count, count = world.count(Contact), len(found.row_a)
    world.resize(Contact, count)
    contact, collider, pose, material = world[Contact], world[Collider], world[ColliderPose], world[Material]
    renew_contacts(
        old_count, world.handles(), world.slots.row_shift,
        found.row_a, found.row_b, found.feature, found.normal, found.depth, found.point,
        found.by_fcl, contact.a, contact.b, contact.feature, contact.row_a, contact.row_b, contact.by_fcl,
        contact.normal, contact.depth, contact.point, contact.resting, contact.warm_normal, contact.warm_friction,
        contact.warm_rolling, contact.impulse, contact.friction_impulse, contact.strikes, contact.plastic,
    )  # fmt: skip
    complete_contacts(
        count, contact.normal, contact.depth, contact.point, contact.row_a, contact.row_b,
        pose.body_row, collider.shape, collider.size, collider.bound_radius, pose.position, pose.rotation,
        world[Flight].detected_center, world[Transform].rotation, world[RigidBody].inverse_mass,
        material.friction, material.restitution, material.rolling_friction, material.spinning_friction,
        material.friction_combine, material.restitution_combine,
        contact.friction, contact.restitution, contact.rolling, contact.spinning,
        contact.body_a, contact.body_b, contact.offset_a, contact.offset_b,
        contact.kind, contact.ball, contact.other, contact.sign, contact.radius, contact.extent,
        contact.other_position, contact.other_rotation,
    )  # fmt: skip
