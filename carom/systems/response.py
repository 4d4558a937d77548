"""Response: resting contacts, and impacts on the arc."""

from __future__ import annotations

from math import inf
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs import Collider, ColliderPose, Material, Motion, Parent, RigidBody, Transform, World, system
from carom.ecs.column import Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.components.joint import Joint
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.systems.awake import Awake, stirs
from carom.systems.constants import MOST_LOOKS
from carom.systems.continuous import Fast
from carom.systems.detection.answered import Answered
from carom.systems.detection.apart import Apart
from carom.systems.detection.broad import BroadPhase
from carom.systems.detection.contacts import detect_again
from carom.systems.detection.fcl_objects import FclObjects
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.leaving import detection_holds
from carom.systems.detection.meshes import PackedMeshes
from carom.systems.detection.seams import Seams
from carom.systems.detection.sensors import Sensing
from carom.systems.kernels.flying_on import FOUND, TO_ASK, fly_on
from carom.systems.kernels.impact_log import write_impacts
from carom.systems.kernels.impacts import DONE, FEW_IMPACTS
from carom.systems.kernels.impacts import WIDTH as LOG_WIDTH
from carom.systems.kernels.settling import finish_drift
from carom.systems.landings import Landings
from carom.systems.ledger import Ledger
from carom.systems.linkage import Linkage
from carom.systems.progress import Progress, Stop
from carom.systems.resting import Resting
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries
from carom.systems.stream import Stream
from carom.systems.threads import Threads, crew_for
from carom.systems.ties import Ties

#: Before a flight.
BEGUN = Stop(reason=DONE, at=0.0, events=0, looks=0.0, soon=FOUND, more=0.0, goes_on=True)


@system(
    reads=(RigidBody, Collider, Material, Parent, Settings, Geometries, Threads, Joint),
    writes=(
        Transform, Motion, Flight, Contact, SleepingContact, ColliderPose, Answered, Apart, BroadPhase, FclObjects,
        PackedHulls, PackedMeshes, Progress, Resting, Seams, Sensing, Awake, Fast, Stream, Ties,
    ),
)  # fmt: skip
def look_ahead(world: World, dt: float) -> None:
    """Detect anew, once for all bodies, where one may leave what detection foresaw and meet somebody new.

    So too where commands have brought or taken entities since: rows may be of others now.
    """
    progress = world[Progress]
    if world[Resting].structure != world.structure or (progress.substep > 1 and not detection_holds(world, dt)):
        world[Resting].hand_over(world)
        detect_again(world, dt)


@system(
    reads=(RigidBody, Transform, Motion, Settings, Threads, Awake, Linkage),
    writes=(Contact, Flight, Progress, Resting, Landings),
)
def sort_out_contacts(world: World, dt: float) -> None:
    """Say which contacts rest in this substep; their bodies count as touching."""
    progress, resting = world[Progress], world[Resting]
    progress.resting = 0
    if resting.groups or world[Linkage].groups:
        resting.pack(world)
    if resting.groups:
        landings = world[Landings] if world[Linkage].groups else None
        if landings:
            landings.expect(world)
        progress.resting = resting.sort(world, dt)
        if landings:
            landings.find(world)


@system(
    reads=(RigidBody, Transform, Settings, Progress, Threads, Awake), writes=(Motion, Contact, Flight, Resting, Linkage)
)
def hold(world: World, dt: float) -> None:
    """Solve the resting contacts: they do not close, stick or slide within the cone, and resist rolling."""
    progress = world[Progress]
    if not (progress.resting or world[Linkage].groups):
        return
    world[Resting].press(world, dt)
    if progress.resting and world[Settings].integrator == "verlet":
        world[Resting].bend(world, dt)


@system(
    reads=(RigidBody, Transform, Flight, Contact, Progress, Settings, Threads, Awake),
    writes=(Motion, Resting, Linkage, Landings, Impact),
)
def relax(world: World, dt: float) -> None:
    """Take the speed by which overlap left out of the velocities again."""
    if world[Progress].resting or world[Linkage].groups:
        world[Resting].relax(world, dt)
    if world[Progress].resting and world[Linkage].groups:
        world[Landings].tell(world, dt)


@system(reads=(Transform, Flight, Settings, Threads, Awake, Fast), writes=(Contact, Resting), when=stirs)
def hand_impulses_over(world: World, dt: float) -> None:
    """Write what the resting stage has found into the contact table, and how far away is what was let go."""
    world[Resting].hand_over(world)
    world[Fast].tell_let_go(world)


@system(
    reads=(RigidBody, Collider, Material, Parent, Settings, Geometries, Threads, Joint, Linkage),
    writes=(
        Transform, Motion, Flight, Contact, SleepingContact, Impact, ColliderPose, Answered, Apart, BroadPhase,
        FclObjects, PackedHulls, PackedMeshes, Progress, Resting, Seams, Sensing, Awake, Fast, Ledger, Stream, Ties,
        Landings,
    ),
)  # fmt: skip
def drift(world: World, dt: float) -> None:
    """Fly every body along its arc, reflected at each impact; detect anew where one may meet whom nobody foresaw."""
    contact, progress, stuck = world[Contact], world[Progress], 0
    stop, progress.stopped = progress.stopped, None
    if stop is None:
        contact.strikes[: contact.count] = contact.plastic[: contact.count] = 0
        stop = _fly_on(world, dt, BEGUN)
    while stop.reason != DONE:
        left = dt - stop.at
        if stop.reason == TO_ASK and detection_holds(world, left):
            stop = _fly_on(world, dt, stop._replace(looks=stop.looks + stop.more))
            continue
        world[Landings].tell(world, dt)
        world[Resting].hand_over(world)
        detect_again(world, left)
        world[Fast].let_go(contact)
        rows, flight = world[Awake].now(world), world[Flight]
        flight.start_center[rows], flight.turned[rows] = flight.center[rows], 0.0  # depths are those of now
        stuck = 0 if stop.goes_on else stuck + 1
        if stuck > 1:  # whose speed has no square leaves any reach at once; it is told at the end of the step
            flight.reach[rows] = inf
        stop = _fly_on(world, dt, stop._replace(looks=stop.looks + 1.0, soon=FOUND))


def _fly_on(world: World, h: float, since: Stop) -> Stop:
    """Fly on to the end of the substep or to what stops the flight; append the impacts on the way to their table."""
    transform, motion, flight, body = world[Transform], world[Motion], world[Flight], world[RigidBody]
    resting, progress, ledger = world[Resting], world[Progress], world[Ledger]
    rows, watched = world[Awake].now(world), world[BroadPhase].watched(world)
    crew, for_groups = crew_for(world, len(rows)), crew_for(world, resting.count)
    ends, cut, looked, given_up, count, pair, log = fly_on(
        crew, for_groups, crew_for(world, max(resting.count, len(watched))),
        MOST_LOOKS, since.at, since.events, since.looks, since.soon, h,
        0.5 if world[Settings].integrator == "verlet" else 0.0,
        progress.clock, progress.substep * h, rows, watched, resting.rows(world),
        flight.center, flight.start_center, transform.rotation, flight.turned, motion.linear, motion.angular,
        flight.time, flight.acceleration, flight.angular_acceleration, flight.felt, world[Stream].motion,
        flight.detected_center, flight.detected_rotation, flight.reach,
        body.center_of_mass, body.inverse_mass, body.inertia, body.inverse_inertia, body.principal_axes, body.freedom,
        flight.held, flight.start_position, flight.start_rotation, flight.decay, flight.angular_decay, flight.flow,
        transform.position,
        resting.count, resting.groups, resting.solids, resting.start, resting.group_of, resting.lane_of,
        resting.index_a, resting.index_b, resting.first, resting.size, resting.points, resting.row, resting.fresh,
        resting.stale, resting.lanes, resting.bodies, resting.closes,
        *contacts_flown_by(world), *world[Fast].columns, ledger.pull, ledger.arc, 0, *room_for_log(),
    )  # fmt: skip
    note_flight(world, cut, looked, given_up, count, pair, log)
    return Stop(*ends)


def contacts_flown_by(world: World) -> tuple[npt.NDArray[Any], ...]:
    """Return what `fly_on` takes of contacts."""
    contact, collider = world[Contact], world[Collider]
    return (
        contact.body_a, contact.body_b, contact.normal, contact.depth, contact.point, contact.offset_a,
        contact.offset_b, contact.share, contact.row_a, contact.row_b, collider.shape, collider.bound_radius,
        contact.kind, contact.ball, contact.other, contact.sign, contact.radius, contact.extent,
        contact.other_position, contact.other_rotation, contact.surface, contact.friction, contact.restitution,
        contact.resting, contact.impulse, contact.friction_impulse, contact.strikes, contact.plastic,
    )  # fmt: skip


def room_for_log() -> tuple[Integers, Floats]:
    """Return room for the pairs of impacts and what is noted of each; kernels make more where it is not enough."""
    return np.empty(FEW_IMPACTS, np.int64), np.empty((FEW_IMPACTS, LOG_WIDTH))


def note_flight(
    world: World, cut: int, looked: int, given_up: int, count: int, pair: Integers, log: Floats
) -> None:  # fmt: skip
    """Append what a flight has noted of its impacts to their table; ``cut`` are those that were let pass.

    And count the looks that were taken and that were given up.
    """
    answered = world[Answered]
    answered.impacts_cut, answered.looks = answered.impacts_cut + cut, answered.looks + looked
    answered.looks_cut += given_up
    if count:
        contact, impact = world[Contact], world[Impact]
        first = impact.count
        world.resize(Impact, first + count)
        write_impacts(
            first, pair[:count], log[:count], contact.a, contact.b, impact.a, impact.b, impact.time, impact.speed,
            impact.impulse, impact.work, impact.point, impact.normal, impact.friction_impulse,
        )  # fmt: skip


@system(reads=(RigidBody, Settings, Threads, Awake, Linkage), writes=(Transform, Motion, Flight, Contact, Resting))
def settle(world: World, dt: float) -> None:
    """End the substep: drag's second half, origins placed, and how deep contacts have come to be."""
    flight, motion, transform, body = world[Flight], world[Motion], world[Transform], world[RigidBody]
    rows = world[Awake].now(world)
    finish_drift(
        crew_for(world, len(rows)), rows, True, dt, body.inverse_mass, body.center_of_mass, body.freedom,
        flight.start_position, flight.start_rotation, flight.decay, flight.angular_decay, flight.flow,
        transform.rotation, flight.center, motion.linear, motion.angular, transform.position,
    )  # fmt: skip
    world[Resting].sink(world)
