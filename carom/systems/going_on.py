"""Going on: where nobody looks on, substeps are taken one after the other with no Python in between."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, Force, Motion, RigidBody, Transform, World, system
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.enter import Inside
from carom.ecs.relations.impact import Impact
from carom.ecs.timings import Timings
from carom.systems.awake import Awake
from carom.systems.constants import MOST_LOOKS
from carom.systems.continuous import Fast
from carom.systems.detection.answered import Answered
from carom.systems.detection.broad import BroadPhase
from carom.systems.detection.sensors import Sensing
from carom.systems.forces.standing import Standing
from carom.systems.integration import SCHEMES
from carom.systems.kernels.crew import ALONE
from carom.systems.kernels.impacts import DONE
from carom.systems.kernels.substeps import take_substeps
from carom.systems.ledger import Ledger
from carom.systems.linkage import Linkage
from carom.systems.progress import Progress, Stop
from carom.systems.response import contacts_flown_by, note_flight, room_for_log
from carom.systems.resting import Resting
from carom.systems.settings import Settings
from carom.systems.stream import Stream
from carom.systems.threads import FEWEST, Threads, crew_for
from carom.systems.ties import Ties
from carom.systems.yielding import relax_sweeps, yielding

#: The systems whose work `take_substeps` does, in its order.
DONE_AT_ONCE = (
    "look_ahead", "predict", "sort_out_contacts", "kick", "hold", "drift", "settle", "relax",
)  # fmt: skip


def nobody_looks_on(world: World) -> bool:
    """Tell whether what is left of a step may be done at once: forces stay, and nobody is told of single systems.

    Joints and sensors ask for more than `take_substeps` does.
    """
    standing, linkage = world[Standing], world[Linkage]
    if not standing.stay or standing.heard or world[Awake].strangers or world[Resting].hearers:
        return False
    joined = linkage.groups or linkage.holds or len(world[Ties].now(world).rows)
    return not (joined or len(world[Sensing].pairs) or world[Inside].count)


@system(
    reads=(
        RigidBody, Collider, ColliderPose, Force, Settings, Awake, BroadPhase, Fast, Inside, Ledger, Linkage, Sensing,
        Standing, Threads, Ties,
    ),
    writes=(Transform, Motion, Flight, Contact, Impact, Answered, Progress, Resting, Stream, Timings),
    when=nobody_looks_on,
)  # fmt: skip
def go_on(world: World, dt: float) -> None:
    """Do all that follows in this substep and the rest at once where nobody looks on; no bit depends on it."""
    progress, resting, settings, contact = world[Progress], world[Resting], world[Settings], world[Contact]
    transform, motion, flight = world[Transform], world[Motion], world[Flight]
    body, force, ledger = world[RigidBody], world[Force], world[Ledger]
    rows, watched = world[Awake].now(world), world[BroadPhase].watched(world)
    crew = crew_for(world, max(len(rows), len(watched), resting.count))
    begun, spent = (world.frame - 1) * settings.dt, np.zeros(len(DONE_AT_ONCE), np.int64)
    number, ends, rests, cut, looked, given_up, count, pair, log = take_substeps(
        crew, ALONE, FEWEST, MOST_LOOKS, progress.substep, settings.substeps, dt, begun,
        SCHEMES[settings.integrator], float(settings.response == "full"), *yielding(dt),
        relax_sweeps(settings.substeps),
        rows, watched, resting.rows(world), contact.count, resting.count, resting.groups, resting.levels,
        resting.solids, resting.balls, resting.start, resting.beside, resting.group_of, resting.lane_of,
        resting.index_a, resting.index_b, resting.first, resting.size, resting.points, resting.row,
        resting.fresh, resting.stale, resting.looks, resting.asks, resting.ends, resting.run_ends, resting.closes,
        resting.leans, resting.lanes, resting.bodies, resting.pages_for(crew),
        resting.crushed, resting.stirred,
        body.center_of_mass, body.inverse_mass, body.inertia, body.inverse_inertia, body.principal_axes, body.freedom,
        force.drag, force.drag_flow, force.angular_drag,
        transform.position, transform.rotation, motion.linear, motion.angular,
        motion.linear_acceleration, motion.angular_acceleration,
        flight.center, flight.time, flight.acceleration, flight.angular_acceleration, flight.felt, flight.decay,
        flight.angular_decay, flight.flow, flight.touching, flight.held, flight.start_position, flight.start_rotation,
        flight.start_linear, flight.start_angular, flight.start_center, flight.turned, world[Stream].motion,
        flight.detected_center, flight.detected_rotation, flight.reach,
        *contacts_flown_by(world), *world[Fast].columns,
        ledger.pull, ledger.arc, *room_for_log(), spent,
    )  # fmt: skip
    note_flight(world, cut, looked, given_up, count, pair, log)
    resting.forget_poses()
    progress.come_to(number, dt, world)
    progress.gone_on, progress.resting = True, rests
    progress.stopped = None if ends[0] == DONE else Stop(*ends)
    world[Timings].share_out("go_on", DONE_AT_ONCE, spent.tolist())


def is_to_begin(world: World) -> bool:
    """Tell whether the substep is still to be gone through system by system."""
    return not world[Progress].gone_on


def is_to_end(world: World) -> bool:
    """Tell whether the flight of the substep has not ended."""
    return not world[Progress].gone_on or world[Progress].stopped is not None
