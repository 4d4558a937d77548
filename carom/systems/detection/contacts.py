"""Broad and narrow phase: from bounds to the contact table."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, Material, Motion, Parent, RigidBody, Transform, World, system
from carom.ecs.column import Booleans, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.components.joint import Joint
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.systems.awake import Awake
from carom.systems.constants import CROWDED
from carom.systems.continuous import Fast, fast_of, of_quick, quick_ones
from carom.systems.detection.answered import Answered
from carom.systems.detection.apart import NOBODY, Apart
from carom.systems.detection.bounds import reach_within, reaches_of
from carom.systems.detection.broad import BroadPhase, overlapping
from carom.systems.detection.fcl_objects import FclObjects
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.meshes import PackedMeshes
from carom.systems.detection.narrow import NOTHING, Found
from carom.systems.detection.recycling import Complete, Kept, measure_what_moved
from carom.systems.detection.seams import Seams, without_seams
from carom.systems.detection.sensors import Sensing, without_sensors
from carom.systems.grouping import group_contacts
from carom.systems.kernels.contacts import complete_contacts
from carom.systems.kernels.crew import threads_of
from carom.systems.kernels.crushing import let_go_of_crushed
from carom.systems.kernels.renewal import renew_contacts
from carom.systems.kernels.rows import are_crowded
from carom.systems.kernels.turning_past import reach_turning
from carom.systems.passing import without_passing
from carom.systems.progress import Progress
from carom.systems.resting import Resting
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries
from carom.systems.sleeping import rouse
from carom.systems.stream import Stream
from carom.systems.threads import Threads, crew_for
from carom.systems.ties import Ties


@system(
    reads=(RigidBody, Collider, Material, Parent, Settings, Geometries, Threads, Joint),
    writes=(
        Transform, Motion, ColliderPose, Contact, SleepingContact, Answered, Apart, Flight, BroadPhase, FclObjects,
        PackedHulls, PackedMeshes, Progress, Resting, Seams, Sensing, Awake, Fast, Stream, Ties,
    ),
)  # fmt: skip
def find_contacts(world: World, dt: float) -> None:
    """Fill the contact table with every pair that touches or may touch within the step; note those of sensors."""
    contact = world[Contact]
    world[Sensing].forget()
    if world[Resting].structure != world.structure:  # now, and not where somebody first meets a mesh
        world[PackedHulls].holding(world)
        world[PackedMeshes].holding(world)
    if contact.count:
        contact.impulse[: contact.count] = contact.friction_impulse[: contact.count] = 0.0
    detect(world, dt, dt / world[Settings].substeps)


def detect_again(world: World, soon: float) -> None:
    """Detect anew ``soon`` seconds before a substep ends, keeping what the step has summed so far."""
    left = soon + world[Progress].foreseen
    reach_within(world, left)
    detect(world, left, soon)


def detect(world: World, left: float, soon: float) -> None:
    """Replace the contact table by one for the current poses, carrying over what known contacts hold.

    It holds for ``left`` seconds; where too many may meet in that time, until the substep ends in ``soon`` seconds. Who
    sleeps and is found by somebody who does not is woken, and looked for in turn.
    """
    progress, pose = world[Progress], world[ColliderPose]
    world[Answered].detections += 1
    progress.detections += 1
    while True:
        pairs = world[Ties].without_joined(world, without_sensors(world, overlapping(world)))
        if soon < left and are_crowded(world.used(), pairs, CROWDED):
            progress.crowded, left, moved = True, soon, np.array(pose.moved)
            reach_within(world, left)
            pose.moved[:] |= moved  # nothing has since it was placed just now, but since the step before
            continue
        center = world[Flight].detected_center
        quick = quick_ones(world, pairs, left, center)
        fast = fast_of(world, of_quick(world, pairs, quick), left, center)
        found, free = find(world, pairs, left), NOBODY
        if len(quick):
            found, free = without_passing(world, found, left, center, quick)
        if not rouse(world, found):
            break
        reach_within(world, left)
    if len(found.row_a) or len(fast[0]):
        np.copyto(world[Flight].detected_rotation, world[Transform].rotation)
    world[Fast].find(world, *fast, free, found, left)
    store(world, without_seams(world, world[Fast].trusted(world, found)), left)
    world[Fast].note(world)


def find(world: World, pairs: Integers, span: float) -> Found:
    """Return the points at which ``pairs`` (n, 2) of collider rows touch or may within ``span`` seconds."""
    if not len(pairs):
        return NOTHING
    collider, pose = world[Collider], world[ColliderPose]
    reaches = reaches_of(world, pairs, world[Flight].reach)
    some = reach_turning(
        pairs, collider.bound_half, collider.bound_radius, pose.turning, pose.body_row, world[RigidBody].inverse_mass,
        reaches,
    )  # fmt: skip
    return measure_what_moved(world, *world[Apart].without(world, pairs, reaches), span if some else 0.0)


def store(world: World, found: Found, left: float) -> None:
    """Write the contact table, matched with the one before, which holds for ``left`` seconds."""
    old_count, count, resting = world[Contact].count, len(found.row_a), world[Resting]
    known = resting.knows(world)
    if not known:
        resting.belts = bool(world[Collider].surface_velocity.any())
    world.resize(Contact, count)
    places, same = fill(world, found, old_count, left, known=known) if count or old_count else (False, False)
    group_contacts(world, places=places, same=same)
    resting.structure, resting.awake = world.structure, world[Awake].now(world)


def fill(world: World, found: Found, old_count: int, left: float, *, known: bool) -> tuple[bool, bool]:
    """Write what is known of contacts, and what follows from it, into the contact table.

    Where all are ``known``, nothing was done from outside since the table before of ``old_count`` contacts. Return
    whether the same contacts were in the same places; and whether, too, what follows from shapes and materials was
    known, and what they hold is what they held.
    """
    moved, changed = (False, False)
    if not isinstance(found, Complete):
        moved, changed = complete(world, found, old_count, left, known=known)
    contact = world[Contact]
    crushed = let_go_of_crushed(
        world[Awake].now(world), contact.count, contact.body_a, contact.body_b, contact.depth,
        world[RigidBody].inverse_mass, world[Motion].linear, world[Motion].angular,
        contact.warm_normal, contact.warm_friction, contact.warm_rolling, world[Resting].crushed_among(world),
    )  # fmt: skip
    places = contact.count == old_count and not moved
    return places, places and not (changed or crushed)


def complete(world: World, found: Found, old_count: int, left: float, *, known: bool) -> tuple[bool, bool]:
    """Replace the contacts by those found, with what follows from their colliders.

    Tell whether any has another place in the table, and whether any of it changed.
    """
    contact, collider, pose, material = world[Contact], world[Collider], world[ColliderPose], world[Material]
    crew, hulls = crew_for(world, contact.count), world[PackedHulls].holding(world)
    changed = np.zeros(threads_of(crew), np.bool_)
    match = found.old if isinstance(found, Kept) else renew(world, crew, found, old_count, changed)
    moved = any(changed.tolist())
    complete_contacts(
        crew, contact.count, match, found.old, known, world[Resting].belts, 0.5 * left, changed,
        contact.normal, contact.depth, contact.point, contact.row_a, contact.row_b, pose.body_row,
        collider.shape, collider.size, collider.geometry, hulls.polyhedron, hulls.face_start, hulls.normals,
        collider.bound_half, collider.bound_radius,
        pose.position, pose.rotation, world[Flight].detected_center, world[Transform].rotation,
        world[Flight].reach, world[Motion].asleep, world[Stream].passes, world[Motion].angular,
        world[RigidBody].inverse_mass, material.friction, material.restitution, material.rolling_friction,
        material.spinning_friction, material.friction_combine, material.restitution_combine, collider.surface_velocity,
        contact.friction, contact.restitution, contact.rolling, contact.spinning, contact.surface,
        contact.body_a, contact.body_b, contact.offset_a, contact.offset_b, contact.share,
        contact.kind, contact.ball, contact.other, contact.sign, contact.radius, contact.extent,
        contact.other_position, contact.other_rotation,
        contact.seat_a, contact.seat_b, contact.lean_a, contact.lean_b, contact.seat_depth, contact.seat_reach,
        contact.form,
    )  # fmt: skip
    return moved, any(changed.tolist())


def renew(world: World, crew: Integers, found: Found, old_count: int, changed: Booleans) -> Integers:
    """Replace the contacts by those found; return which of the old each was, -1 for none.

    Threads tell in ``changed`` whether one has come to a place in which it was not.
    """
    contact, collider, match = world[Contact], world[Collider], np.empty(len(found.row_a), np.int64)
    renew_contacts(
        crew, match, np.zeros(old_count, np.bool_), changed, old_count,
        world.handles(), world.slots.row_shift, collider.bound_half, collider.bound_radius,
        found.row_a, found.row_b, found.feature, found.normal, found.depth, found.point, found.by_fcl,
        found.old, contact.a, contact.b, contact.feature, contact.row_a, contact.row_b, contact.by_fcl,
        contact.normal, contact.depth, contact.point, contact.resting, contact.warm_normal, contact.warm_friction,
        contact.warm_rolling, contact.impulse, contact.friction_impulse, contact.strikes, contact.plastic,
        contact.seat_a, contact.seat_b, contact.lean_a, contact.lean_b, contact.seat_depth, contact.seat_reach,
        contact.form, contact.body_a, contact.body_b, contact.offset_a, contact.offset_b, contact.share,
        contact.friction, contact.restitution, contact.rolling, contact.spinning, contact.surface, contact.kind,
    )  # fmt: skip
    return match
