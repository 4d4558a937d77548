"""Sleeping: islands at rest are left alone until something touches or changes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from carom.ecs import (
    Collider,
    ColliderPose,
    ExternalForce,
    Force,
    Material,
    Motion,
    Parent,
    RigidBody,
    Transform,
    World,
    system,
)
from carom.ecs.column import Booleans, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.components.joint import Joint
from carom.ecs.components.path import Path
from carom.ecs.components.spring import Spring
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.systems.awake import Awake, ask_to_wake, stirs
from carom.systems.bodies import centers_of_mass
from carom.systems.constants import SLEEP_TIME
from carom.systems.detection.bounds import reach_within
from carom.systems.forces.law import Forces
from carom.systems.forces.reach import NOBODY
from carom.systems.forces.springs import bodies_on_springs
from carom.systems.kernels.islands import find_sleepers, time_stillness
from carom.systems.links import islands, joins_islands, links, nearby
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries
from carom.systems.sleeping_contacts import left_alone, locate_contacts, move_contacts
from carom.systems.stream import Stream
from carom.systems.ties import Ties

if TYPE_CHECKING:
    from carom.systems.detection.narrow import Found

SHAPED = {RigidBody, Collider, Material, Parent}  # nobody knows who rests on what these say
PLACED = {Transform, Motion, ExternalForce}


@system(
    reads=(RigidBody, Collider, ExternalForce, Parent, Path, Settings, Forces, Joint, Spring),
    writes=(Transform, Motion, Flight, ColliderPose, Contact, SleepingContact, Awake, Stream, Ties),
)
def wake_disturbed(world: World, dt: float) -> None:
    """Wake who was changed from outside since the last step, and see whether there is anything to do."""
    awake = world[Awake]
    changes, turned = awake.look(world), _turned(world)
    changed = bool(changes)
    if changed or awake.strangers:
        awake.find(world)
    asked = awake.sleepers
    if len(asked):
        asked = asked[world[Motion].still[asked] < 0.0]
    if not (changed or len(asked) or len(turned)) and awake.idle:
        return
    ties, joined = world[Ties], Joint in changes.edited
    if joined or changes.structure or changes.restored:
        held = ties.bodies
        joined |= ties.find(world) and not changes.restored
    if changes.restored:  # what snapshots do not keep
        place_frozen(world, awake.sleepers)
        locate_contacts(world)
    if len(awake.sleepers):
        # Snapshots keep that somebody was moved since the last step, and not who.
        remade = changes.edited & SHAPED or (changes.restored and Transform in changes.edited)
        if not world[Settings].sleeping or remade or (changes.settings and not changes.restored):
            wake(world, awake.sleepers)
        else:
            disturbed = [asked, turned, bodies_on_springs(world)]  # springs may be new
            if awake.strangers or changes.edited & PLACED:
                disturbed.append(_changed(world, awake.sleepers))
            if changes.structure:
                disturbed.append(left_alone(world))
            if joined:
                disturbed += [held, ties.bodies]
            wake(world, np.concatenate(disturbed))
    awake.idle = not changed and awake.nobody_moves(world)


@system(
    reads=(RigidBody, Collider, Parent, Geometries, Force, Forces, Settings, Joint, Spring),
    writes=(Transform, Motion, Flight, ColliderPose, Contact, SleepingContact, Awake, Stream, Ties),
    when=stirs,
)
def fall_asleep(world: World, dt: float) -> None:
    """Let islands that have been still for long enough fall asleep: they stop, and nothing of them changes."""
    motion, body, contact, awake = world[Motion], world[RigidBody], world[Contact], world[Awake]
    if not world[Settings].sleeping:
        return
    if awake.strangers and len(awake.sleepers):  # one of them may be pushing
        force = world[Force]
        pushed = (force.force[awake.sleepers] != 0.0) | (force.torque[awake.sleepers] != 0.0)
        ask_to_wake(motion, awake.sleepers[pushed.any(axis=1)])
    motion.still[world[Ties].now(world).restless] = -dt  # who is turned by a motor
    for _, rows in world[Forces].restless(world):
        motion.still[rows] = -dt  # who is pushed another way in every step
    motion.still[bodies_on_springs(world)] = -dt  # and who is pulled another way as soon as the other end moves
    time_stillness(
        awake.rows, dt, body.inverse_mass, body.inertia, body.sleeps, motion.linear, motion.angular, motion.still
    )
    falls: Booleans = np.zeros(len(motion.asleep), np.bool_)
    if not (motion.still[awake.rows] >= SLEEP_TIME).any():
        return
    if find_sleepers(
        awake.rows, *links(world, Contact), *nearby(world), body.inverse_mass, world[Forces].borne(world),
        motion.linear, motion.angular, world[Flight].felt, motion.still, falls,
    ):  # fmt: skip
        rows = np.nonzero(falls)[0]
        motion.asleep[rows] = True
        freeze(world, rows)
        a, b = contact.body_a[: contact.count], contact.body_b[: contact.count]
        move_contacts(world, Contact, SleepingContact, joins_islands(contact) & (_among(a, falls) | _among(b, falls)))
        awake.find(world)


def wake(world: World, rows: Integers) -> None:
    """Wake the islands of bodies that sleep; their contacts are as they were."""
    rows = rows[world[Motion].asleep[rows]]
    if not len(rows):
        return
    motion, sleeping, awake = world[Motion], world[SleepingContact], world[Awake]
    island, count = islands(world, awake.sleepers, SleepingContact), sleeping.count
    a, b = sleeping.body_a[:count], sleeping.body_b[:count]
    woken: Booleans = np.zeros(len(island), np.bool_)
    woken[awake.sleepers] = np.isin(island[awake.sleepers], island[rows])
    motion.asleep[woken], motion.still[woken] = False, 0.0
    which = _among(a, woken) | _among(b, woken)
    sleeping.impulse[:count][which], sleeping.friction_impulse[:count][which] = 0.0, 0.0  # of this step, until now
    move_contacts(world, SleepingContact, Contact, which)
    awake.find(world)


def rouse(world: World, found: Found) -> bool:
    """Wake who sleeps and is found by somebody, or whose support was moved; tell whether anybody was."""
    awake = world[Awake]
    if not len(awake.sleepers):
        return False
    asleep, pose, sleeping = world[Motion].asleep, world[ColliderPose], world[SleepingContact]
    near = [pose.body_row[row] for row in (found.row_a, found.row_b)]
    rows, count = world.row_numbers(Collider), sleeping.count
    if (moved := pose.moved[rows]).any():
        near.append(pose.body_row[rows[moved]])
        left = pose.moved[sleeping.row_a[:count]] | pose.moved[sleeping.row_b[:count]]
        near += [sleeping.body_a[:count][left], sleeping.body_b[:count][left]]
    bodies = np.concatenate(near)
    bodies = bodies[bodies >= 0]
    bodies = bodies[asleep[bodies]]
    wake(world, bodies)
    return len(bodies) > 0


def freeze(world: World, rows: Integers) -> None:
    """Stop bodies where they are, and their colliders with them, as the next substep would find them."""
    motion = world[Motion]
    for velocity in (motion.linear, motion.angular, motion.linear_acceleration, motion.angular_acceleration):
        velocity[rows] = 0.0
    place_frozen(world, rows)


def place_frozen(world: World, rows: Integers) -> None:
    """Put what the step has of bodies beside their state where they stand."""
    transform, flight = world[Transform], world[Flight]
    for column in (
        flight.start_linear, flight.start_angular, flight.acceleration, flight.angular_acceleration,
        flight.flow, flight.turned,
    ):  # fmt: skip
        column[rows] = 0.0
    flight.reach[rows], flight.time[rows] = 0.0, 0.0
    flight.touching[rows] = flight.held[rows] = False
    flight.decay[rows], flight.angular_decay[rows] = 1.0, 1.0
    flight.start_position[rows], flight.start_rotation[rows] = transform.position[rows], transform.rotation[rows]
    for center in (flight.center, flight.start_center, flight.detected_center):
        center[rows] = centers_of_mass(world, rows)
    reach_within(world, 0.0, np.union1d(world[Awake].now(world), rows))  # the same also where they sleep already


def _among(rows: Integers, mask: Booleans) -> Booleans:
    """Tell which rows are in a mask; -1 is not."""
    found: Booleans = mask[rows] & (rows >= 0)
    return found


def _turned(world: World) -> Integers:
    """Return who comes to be pushed in this step, or is pushed no more, since the time window of a law says so."""
    forces, settings = world[Forces], world[Settings]
    if not forces.limits:
        return NOBODY
    begin = (world.frame - 1) * settings.dt  # and the half of the last substep in which that was too early to tell
    return forces.turned(world, begin - settings.dt / settings.substeps, begin + settings.dt)


def _changed(world: World, rows: Integers) -> Integers:
    """Return those that were moved, given a velocity or pushed."""
    transform, motion, flight, external = world[Transform], world[Motion], world[Flight], world[ExternalForce]
    moved = (transform.position[rows] != flight.start_position[rows]).any(axis=1)
    moved |= (transform.rotation[rows] != flight.start_rotation[rows]).any(axis=1)
    for values in (motion.linear, motion.angular, external.force, external.torque):
        moved |= (values[rows] != 0.0).any(axis=1)
    return np.asarray(rows[moved])
