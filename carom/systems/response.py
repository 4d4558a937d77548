"""Response: resting contacts, and impacts on the arc."""

from __future__ import annotations

from math import inf

import numpy as np

from carom.ecs import Collider, ColliderPose, Material, Motion, Parent, RigidBody, Transform, World, system
from carom.ecs.column import Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.components.joint import Joint
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.systems.awake import Awake, stirs
from carom.systems.closing import closing
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
from carom.systems.kernels.advancing import advance_bodies
from carom.systems.kernels.impact_log import write_impacts
from carom.systems.kernels.impacts import DONE, FEW_IMPACTS, TO_LOOK, fly
from carom.systems.kernels.impacts import WIDTH as LOG_WIDTH
from carom.systems.kernels.settling import finish_drift
from carom.systems.landings import Landings
from carom.systems.ledger import Ledger
from carom.systems.linkage import Linkage
from carom.systems.progress import Progress
from carom.systems.resting import Resting
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries
from carom.systems.stream import Stream
from carom.systems.threads import Threads, crew_for
from carom.systems.ties import Ties


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


@system(reads=(Settings, Threads, Awake), writes=(Contact, Resting), when=stirs)
def hand_impulses_over(world: World, dt: float) -> None:
    """Write what the resting stage has found into the contact table."""
    world[Resting].hand_over(world)


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
    contact, progress, fast = world[Contact], world[Progress], world[Fast]
    at, events, looks, stuck, soon = 0.0, 0, 0.0, 0, None
    begun, progress.stopped = progress.stopped, None
    if contact.count and not begun:
        contact.strikes[: contact.count] = contact.plastic[: contact.count] = 0
    while True:
        before = at, events
        if begun:
            (at, reason, events), begun = begun, None
        else:
            look = at + (fast.next_look(world, dt - at, found=True) if soon is None else soon)
            if looks >= MOST_LOOKS and look < inf:
                look, world[Answered].looks_cut = inf, world[Answered].looks_cut + 1
            at, reason, events = _fly(world, at, dt, events, look)
        if reason == DONE:
            return
        _finish(world, dt, ended=False)
        left = dt - at
        soon = fast.look_on(world, at - before[0], left) if looks < MOST_LOOKS else inf
        told = soon == 0.0 and (at, events) != before and fast.tells(world, left)
        if told:
            _begin_anew(world)
            soon = fast.next_look(world, left, found=False)
        holds = soon > 0.0 and (at, events) != before and (reason == TO_LOOK or detection_holds(world, left))
        if told and holds:  # each pair at its own time
            looks += 1.0 / len(fast.all.pairs)
        else:
            looks += not holds or events == before[1]  # there is an end to impacts anyway
        if holds:
            continue
        soon = None
        world[Landings].tell(world, dt)
        world[Resting].hand_over(world)
        detect_again(world, left)
        fast.let_go(contact)
        _begin_anew(world)
        stuck = stuck + 1 if (at, events) == before else 0
        if stuck > 1:  # whose speed has no square leaves any reach at once; it is told at the end of the step
            world[Flight].reach[world[Awake].now(world)] = inf


def _begin_anew(world: World) -> None:
    """Let bodies fly on from where they are: depths are those of now."""
    rows, flight = world[Awake].now(world), world[Flight]
    flight.start_center[rows], flight.turned[rows] = flight.center[rows], 0.0


def _fly(world: World, at: float, h: float, events: int, until: float) -> tuple[float, int, int]:
    """Fly to the end of the substep or to what stops the flight; append the impacts on the way to their table."""
    transform, motion, flight, body = world[Transform], world[Motion], world[Flight], world[RigidBody]
    ledger, bend = world[Ledger], 0.5 if world[Settings].integrator == "verlet" else 0.0
    now, reason = h, DONE
    if world[Resting].count or len(world[BroadPhase].watched(world)) or until < h:
        now, reason, events = _meet(world, at, h, bend, events, until)
    rows = world[Awake].now(world)
    advance_bodies(
        crew_for(world, len(rows)), rows, now, bend, flight.center, transform.rotation, flight.turned,
        motion.linear, motion.angular, flight.time, flight.acceleration, flight.angular_acceleration,
        body.inverse_mass, body.inertia, body.principal_axes, body.freedom, ledger.pull, ledger.arc,
    )  # fmt: skip
    world[Stream].flow(now - at)
    return now, reason, events


def _meet(world: World, at: float, h: float, bend: float, events: int, until: float) -> tuple[float, int, int]:
    """Find what stops the flight; those who meet before that are where they meet last, on their arcs from there."""
    transform, motion, flight, body = world[Transform], world[Motion], world[Flight], world[RigidBody]
    collider = world[Collider]
    contact, manifolds, ledger = world[Contact], world[Resting], world[Ledger]
    began = at == 0.0
    closes, within, some = closing(world, h - at, began=began)
    if began and not some and h <= min(within, until):
        return h, DONE, events
    now, reason, events, cut, count, pair, log = fly(
        at, h, bend, world[Progress].clock,
        flight.center, flight.start_center, transform.rotation, flight.turned, motion.linear, motion.angular,
        flight.time, flight.acceleration, flight.angular_acceleration,
        flight.felt, world[Stream].motion, flight.detected_center, flight.detected_rotation,
        flight.reach,
        body.inverse_mass, body.inertia, body.inverse_inertia, body.principal_axes, body.freedom,
        manifolds.count, manifolds.start, manifolds.group_of, manifolds.stale,
        contact.body_a, contact.body_b, contact.normal, contact.depth, contact.point, contact.offset_a,
        contact.offset_b, contact.share, contact.row_a, contact.row_b, collider.shape, collider.bound_radius,
        contact.kind, contact.ball, contact.other,
        contact.extent, contact.radius, contact.other_position, contact.other_rotation, contact.sign,
        contact.surface, contact.friction, contact.restitution, contact.resting,
        contact.impulse, contact.friction_impulse, contact.strikes, contact.plastic, closes, within,
        flight.held, until, world[Fast].trusts, events, ledger.pull, ledger.arc, 0, *room_for_log(),
    )  # fmt: skip
    log_impacts(world, cut, count, pair, log)
    return now, reason, events


def room_for_log() -> tuple[Integers, Floats]:
    """Return room for the pairs of impacts and what is noted of each; kernels make more where it is not enough."""
    return np.empty(FEW_IMPACTS, np.int64), np.empty((FEW_IMPACTS, LOG_WIDTH))


def log_impacts(world: World, cut: int, count: int, pair: Integers, log: Floats) -> None:
    """Append what a flight has noted of its impacts to their table; ``cut`` are those that were let pass."""
    world[Answered].impacts_cut += cut
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
    _finish(world, dt, ended=True)
    world[Resting].sink(world)


def _finish(world: World, dt: float, *, ended: bool) -> None:
    flight, motion, transform, body = world[Flight], world[Motion], world[Transform], world[RigidBody]
    rows = world[Awake].now(world)
    finish_drift(
        crew_for(world, len(rows)), rows, ended, dt, body.inverse_mass, body.center_of_mass, body.freedom,
        flight.start_position, flight.start_rotation, flight.decay, flight.angular_decay, flight.flow,
        transform.rotation, flight.center, motion.linear, motion.angular, transform.position,
    )  # fmt: skip
