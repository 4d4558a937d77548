"""Free-body diagrams: every force on every body, told apart, for observers; the step never calls this."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from carom.ecs import ExternalForce, Force, Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Record
from carom.ecs.components.joint import Joint
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.ecs.spatial import quaternion
from carom.systems.awake import Awake
from carom.systems.bodies import centers_of_mass, dynamic_rows
from carom.systems.ends import ends_there
from carom.systems.events import Events
from carom.systems.forces.law import Forces, Law
from carom.systems.progress import Progress
from carom.systems.settings import Random, time_of
from carom.systems.simulation import Simulation

APPLY = "apply_"  # what names of systems begin with, and those of forces do not
NORMAL, FRICTION, JOINT, EXTERNAL = "normal", "friction", "joint", "external"


class Loads(NamedTuple):
    """Forces (n, 3) in N, world frame: on which body (row), at which point (n, 3) in m, and what each is called."""

    body: Integers
    point: Floats
    force: Floats
    name: list[str]


def loads(simulation: Simulation) -> Loads:
    """Return the forces on all dynamic bodies that are not zero.

    Those of laws, own systems and from outside act on centres of mass unless a law says where, as poses and velocities
    are now; normal forces and friction act where colliders touch, those of joints at the anchor of b, those of events
    and explosions where they go past the centre of mass: impulses of the last step over its time.
    """
    world, dt = simulation.world, simulation.settings.dt
    found = [*applied(simulation), *pushed(world, dt), *contacts(world, dt), *joints(world)]
    dynamic = np.zeros(world.used() + 1, np.bool_)  # the last is for -1, what has no body
    dynamic[dynamic_rows(world)] = True
    kept = [dynamic[part.body] & part.force.any(axis=1) for part in found]
    body, point, force = (
        np.concatenate([getattr(part, column)[keep] for part, keep in zip(found, kept, strict=True)])
        for column in ("body", "point", "force")
    )
    names = [name for part, keep in zip(found, kept, strict=True) for name in np.array(part.name)[keep].tolist()]
    return Loads(body, point, force, names)


def applied(simulation: Simulation) -> list[Loads]:
    """Return what each system that adds forces adds to a sum of its own, and the forces from outside."""
    world = simulation.world
    rows = dynamic_rows(world)
    sums = SimpleNamespace(**{name: np.zeros_like(getattr(world[Force], name)) for name in Force.columns})
    everyone = Awake()
    everyone.rows, everyone.found = world.row_numbers(RigidBody), world.structure
    step = simulation.settings.dt / simulation.settings.substeps
    parts = {EXTERNAL: world[ExternalForce].force[rows]}
    before = np.zeros((len(rows), 3))
    drawn = world[Random].state()
    forces, now = world[Forces].at(world, time_of(world)), Progress()
    now.clock = time_of(world) - 0.5 * step  # forces of a substep are those in its middle
    with world.faces(Instead(world, {Force: sums, Awake: everyone, Forces: forces, Progress: now})):
        for _, system in simulation.schedule:
            if Force in system.adds:
                system(world, step)
                now = sums.force[rows] + sums.drag_flow[rows] - sums.drag[rows, None] * world[Motion].linear[rows]
                parts[name_of(system.name)] = now - before
                before = now
    world[Random].restore(drawn)  # a force may draw numbers, and who looks on must not change those of the step
    centers = centers_of_mass(world, rows)
    points = dict.fromkeys(parts, centers) | {name: at[rows] for name, at in stated_points(world, forces).items()}
    return [Loads(rows, points[name], force, [name] * len(rows)) for name, force in parts.items()]


def stated_points(world: World, forces: Forces) -> dict[str, Floats]:
    """Return where laws that say so act on each row in use, by their names; of several of a kind the last says it."""
    found = {}
    for kind in forces.entries:
        if kind.points is not Law.points:
            at = np.zeros((world.used(), 3))
            bodies = world.row_numbers(RigidBody)
            at[bodies] = centers_of_mass(world, bodies)
            for law, rows in forces.acting(kind, world):
                at[rows] = law.points(world, rows)
            found[name_of(kind.key)] = at
    return found


def name_of(key: str) -> str:
    """Return what the force of a system or law is called."""
    return key.removeprefix(APPLY).replace("_", " ")


def pushed(world: World, dt: float) -> list[Loads]:
    """Return the mean forces over the last step of the impulses that events and calls gave in it."""
    return [Loads(one.rows, one.point, one.impulse / dt, [one.name] * len(one.rows)) for one in world[Events].pushed]


def contacts(world: World, dt: float) -> list[Loads]:
    """Return the mean normal forces and friction of the last step on both sides of each contact."""
    found = []
    for kind in (Contact, SleepingContact):
        table, live = world[kind], slice(0, world[kind].count)
        normal = table.impulse[live, None] * table.normal[live]
        for name, impulse in ((NORMAL, normal), (FRICTION, table.friction_impulse[live])):
            for body, sign in ((table.body_a[live], -1.0), (table.body_b[live], 1.0)):
                found.append(Loads(body, table.point[live], sign / dt * impulse, [name] * len(body)))
    return found


def joints(world: World) -> list[Loads]:
    """Return the mean forces of the last step by which joints hold, drive and rub both bodies."""
    joint, transform = world[Joint], world[Transform]
    rows, a, b = ends_there(world, Joint)
    point, held = joint.anchor_b[rows], b >= 0
    point[held] = transform.position[b[held]] + quaternion.rotate(transform.rotation[b[held]], point[held])
    return [Loads(body, point, sign * joint.force[rows], [JOINT] * len(rows)) for body, sign in ((a, -1.0), (b, 1.0))]


class Instead(dict[Any, Any]):
    """What a world shows while functions run on some tables and resources in the place of its own."""

    def __init__(self, world: World, replaced: dict[Any, Any]) -> None:
        super().__init__(replaced)
        self._world, self._own = world, world.faces(None).faces

    def __missing__(self, key: Any) -> Any:
        if isinstance(key, type) and issubclass(key, Record):
            self._world.table(key)  # made on first use
        return self._own[key]
