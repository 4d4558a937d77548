"""Response: resting contacts, impacts on the arc, and overlap."""

from __future__ import annotations

from math import sqrt

import numpy as np

from carom.ecs import Collider, ColliderPose, Material, Motion, Parent, RigidBody, Transform, World, system
from carom.ecs.commands import Commands
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.enter import Enter, Inside
from carom.ecs.relations.impact import Impact
from carom.systems.detection.answered import Answered
from carom.systems.detection.broad import BroadPhase
from carom.systems.detection.contacts import detect_again
from carom.systems.detection.fcl_objects import FclObjects
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.meshes import PackedMeshes
from carom.systems.kernels.impacts import DONE, FRICTION, IMPULSE, NORMAL, POINT, SPEED, TIME, fly
from carom.systems.kernels.resting import hold_contacts
from carom.systems.kernels.settling import finish_drift
from carom.systems.kernels.sorting import sort_contacts
from carom.systems.progress import Progress
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries


@system(reads=(RigidBody, Transform, Motion, Settings), writes=(Contact, Flight, Progress))
def sort_out_contacts(world: World, dt: float) -> None:
    """Say which contacts rest in this substep; their bodies count as touching."""
    contact = world[Contact]
    if not contact.count:
        return
    flight, motion = world[Flight], world[Motion]
    world[Progress].resting = sort_contacts(
        contact.count, dt, world[Settings].response == "full", flight.center, world[Transform].rotation,
        motion.linear, motion.angular, flight.felt,
        contact.kind, contact.ball, contact.other, contact.sign, contact.radius, contact.extent,
        contact.other_position, contact.other_rotation, contact.body_a, contact.body_b,
        contact.normal, contact.depth, contact.point, contact.offset_a, contact.offset_b, contact.resting,
        flight.touching, contact.warm_normal, contact.warm_friction, contact.warm_rolling,
    )  # fmt: skip


@system(reads=(RigidBody, Transform, Settings, Progress), writes=(Motion, Contact, Flight, Impact))
def hold(world: World, dt: float) -> None:
    """Solve the resting contacts: they do not close, stick or slide within the cone, and resist rolling."""
    contact = world[Contact]
    if not contact.count or not world[Progress].resting:
        return
    flight, motion, body = world[Flight], world[Motion], world[RigidBody]
    pull = sqrt(sum(g * g for g in world[Settings].gravity))
    blows = hold_contacts(
        contact.count, dt, pull, world[Settings].integrator == "verlet",
        contact.body_a, contact.body_b, contact.normal, contact.depth,
        contact.offset_a, contact.offset_b, contact.kind, contact.resting,
        contact.friction, contact.restitution, contact.rolling, contact.spinning,
        body.inverse_mass, body.inverse_inertia, body.principal_axes, world[Transform].rotation,
        flight.start_linear, flight.start_angular, motion.linear, motion.angular,
        flight.acceleration, flight.angular_acceleration, flight.touching, contact.blow,
        contact.impulse, contact.friction_impulse, contact.warm_normal, contact.warm_friction, contact.warm_rolling,
    )  # fmt: skip
    if blows:
        log_blows(world)


def log_blows(world: World) -> None:
    """Log an impact per pair that the resting stage made bounce: one row for all points of its manifold."""
    contact = world[Contact]
    rows = np.nonzero(contact.blow[: contact.count] > 0.0)[0]
    pairs = np.stack([contact.a[rows], contact.b[rows]], axis=1)
    for a, b in sorted(set(map(tuple, pairs.tolist()))):
        of_pair = rows[(pairs == (a, b)).all(axis=1)]
        at = world.count(Impact)
        world.resize(Impact, at + 1)
        impact = world[Impact]
        impact.time[at], impact.a[at], impact.b[at] = world[Progress].clock, a, b
        impact.point[at], impact.normal[at] = contact.point[of_pair].mean(axis=0), contact.normal[of_pair[0]]
        impact.speed[at] = contact.blow[of_pair].max()
        impact.impulse[at] = contact.warm_normal[of_pair].sum()
        impact.friction_impulse[at] = contact.warm_friction[of_pair].sum(axis=0)


@system(
    reads=(RigidBody, Collider, Material, Parent, Settings, Geometries, Progress),
    writes=(
        Transform, Motion, Flight, Contact, Impact, ColliderPose, Enter, Inside, Answered, BroadPhase, FclObjects,
        PackedHulls, PackedMeshes, Commands,
    ),
)  # fmt: skip
def drift(world: World, dt: float) -> None:
    """Fly every body along its arc, reflected at each impact; detect anew where one leaves what detection foresaw."""
    contact = world[Contact]
    contact.strikes[: contact.count] = contact.plastic[: contact.count] = 0
    at, events = 0.0, 0
    while True:
        at, reason, events = _fly(world, at, dt, events)
        if reason == DONE:
            return
        _finish(world, at, ended=False)
        detect_again(world, world[Progress].left + dt - at)


def _fly(world: World, at: float, h: float, events: int) -> tuple[float, int, int]:
    """Fly to the end of the substep or to what stops the flight; append the impacts on the way to their table."""
    transform, motion, flight, body = world[Transform], world[Motion], world[Flight], world[RigidBody]
    contact, progress, settings = world[Contact], world[Progress], world[Settings]
    now, reason, events, cut, count, pair, log = fly(
        world.row_numbers(RigidBody), at, h, progress.left, 0.5 if settings.integrator == "verlet" else 0.0,
        progress.clock, flight.center, transform.rotation, motion.linear, motion.angular, flight.time,
        flight.acceleration, flight.angular_acceleration, flight.felt, flight.detected_center, flight.reach,
        body.inverse_mass, body.inertia, body.inverse_inertia, body.principal_axes,
        contact.kind[: contact.count], contact.ball, contact.other, contact.extent, contact.radius,
        contact.other_position, contact.other_rotation, contact.sign, contact.friction, contact.restitution,
        contact.resting, contact.impulse, contact.friction_impulse, contact.strikes, contact.plastic, events,
    )  # fmt: skip
    world[Answered].impacts_cut += cut
    if count:
        first = world.count(Impact)
        world.resize(Impact, first + count)
        impact, new, pair, log = world[Impact], slice(first, first + count), pair[:count], log[:count]
        impact.a[new], impact.b[new] = contact.a[pair], contact.b[pair]
        impact.time[new], impact.speed[new], impact.impulse[new] = log[:, TIME], log[:, SPEED], log[:, IMPULSE]
        for column, at_column in ((impact.point, POINT), (impact.normal, NORMAL), (impact.friction_impulse, FRICTION)):
            column[new] = log[:, at_column : at_column + 3]
    return now, reason, events


@system(reads=(RigidBody,), writes=(Transform, Motion, Flight, Contact))
def settle(world: World, dt: float) -> None:
    """End the substep: drag's second half, overlap pushed out without adding velocity, origins placed."""
    _finish(world, dt, ended=True)


def _finish(world: World, dt: float, *, ended: bool) -> None:
    flight, motion, body, contact = world[Flight], world[Motion], world[RigidBody], world[Contact]
    finish_drift(
        world.row_numbers(RigidBody), contact.count if ended else 0, dt, ended, body.center_of_mass, body.inverse_mass,
        flight.decay, flight.angular_decay, flight.flow, world[Transform].rotation,
        contact.body_a, contact.body_b, contact.normal, contact.offset_a, contact.offset_b, contact.kind,
        contact.resting, flight.start_center, motion.linear, motion.angular,
        world[Transform].position, flight.center, contact.depth,
    )  # fmt: skip
