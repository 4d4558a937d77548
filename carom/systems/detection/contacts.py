"""Broad and narrow phase: from bounds to the contact table."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs import Collider, ColliderPose, Material, Motion, RigidBody, Transform, World, system
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.entity import INDEX_MASK
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.enter import Enter, Inside
from carom.systems.detection.answered import Answered
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.fcl_pairs import FclObjects, measure_by_fcl
from carom.systems.detection.sensors import sense
from carom.systems.kernels.broad import sweep_bounds
from carom.systems.kernels.contacts import complete_contacts, match_contacts, measure_balls, reach_of_pairs
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.plane import Plane

CARRIED = ("warm_normal", "warm_friction", "warm_rolling", "resting", "impulse", "friction_impulse")


class Found(NamedTuple):
    """Contact points in order of (row a, row b, feature)."""

    row_a: Integers
    row_b: Integers
    feature: Integers
    normal: Floats
    depth: Floats
    point: Floats
    by_fcl: Booleans


@system(
    reads=(Transform, Motion, RigidBody, Collider, Material, Settings, Geometries),
    writes=(ColliderPose, Contact, Enter, Inside, Answered, Flight, FclObjects),
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
    """Return the contact points of all pairs whose bounds overlap."""
    collider, pose, flight = world[Collider], world[ColliderPose], world[Flight]
    pairs = overlapping(world)
    reaches = reach_of_pairs(pairs, pose.body_row, flight.reach)
    answered = world[Answered]
    if world[Settings].collision == "fcl":
        by_kernel = np.zeros(len(pairs), np.bool_)
        closed = None
    else:
        by_kernel, normal, depth, point = measure_balls(
            pairs, reaches, collider.shape, collider.size, pose.position, pose.rotation
        )
        near = by_kernel & (depth >= -reaches)
        answered.kernels += int(np.count_nonzero(by_kernel))
        zeros = np.zeros(int(np.count_nonzero(near)), np.int64)
        closed = Found(pairs[near, 0], pairs[near, 1], zeros, normal[near], depth[near], point[near], zeros != 0)
    open_pairs = ~by_kernel
    if closed is not None and not open_pairs.any():
        return closed
    answered.fcl += int(np.count_nonzero(open_pairs))
    measured = measure_by_fcl(world, pairs[open_pairs], reaches[open_pairs])
    parts = [measured] if closed is None else [closed, measured]
    joined = [np.concatenate(columns) for columns in zip(*parts, strict=True)]
    order = np.lexsort((joined[2], joined[1], joined[0]))
    return Found(*(column[order] for column in joined))


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
    contact = world[Contact]
    old = slice(0, contact.count)
    a, b = world.entities(found.row_a), world.entities(found.row_b)
    match = match_contacts(
        contact.a[old] & INDEX_MASK, contact.b[old] & INDEX_MASK, contact.feature[old].copy(),
        found.row_a, found.row_b, found.feature,
    )  # fmt: skip
    known = match >= 0
    known[known] = (contact.a[match[known]] == a[known]) & (contact.b[match[known]] == b[known])
    carried = {name: getattr(contact, name)[match[known]] for name in CARRIED}
    count = len(a)
    world.resize(Contact, count)
    contact = world[Contact]
    new = slice(0, count)
    for name, values in carried.items():
        column = getattr(contact, name)
        column[new] = 0
        column[new][known] = values
    contact.a[new], contact.b[new], contact.feature[new] = a, b, found.feature
    contact.row_a[new], contact.row_b[new], contact.by_fcl[new] = found.row_a, found.row_b, found.by_fcl
    contact.normal[new], contact.depth[new], contact.point[new] = found.normal, found.depth, found.point
    collider, pose, material = world[Collider], world[ColliderPose], world[Material]
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
