"""Fields: forces on particles, by the very systems that apply them to bodies.

A chunk of particles stands in a small world of its own as bodies; there the force systems of the step run. So a law
has one formula, and a user's Python function acts on particles as it is. Where only gravity, even winds and drags act,
which are the same for all particles of an emitter, nobody needs to stand anywhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from carom.ecs import Component, Force, Motion, RigidBody, System, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.components.emitter import Emitter
from carom.ecs.components.flight import Flight
from carom.ecs.relations.particle import Particle
from carom.systems.awake import Awake
from carom.systems.forces.attraction import apply_attraction
from carom.systems.forces.constant_push import apply_constant_push
from carom.systems.forces.drag import LinearDrag, QuadraticDrag, apply_linear_drag, apply_quadratic_drag
from carom.systems.forces.gravity import apply_gravity
from carom.systems.forces.gravity_well import apply_gravity_well
from carom.systems.forces.law import Forces, Law, choose_bodies
from carom.systems.forces.reach import Reach
from carom.systems.forces.vortex import apply_vortex
from carom.systems.forces.wind import Wind, apply_wind
from carom.systems.integration import clear_forces
from carom.systems.kernels.lanes import WIDTH, aligned
from carom.systems.kernels.particle_arcs import ARC_ROWS, CHUNK, lay_arcs
from carom.systems.progress import Progress
from carom.systems.settings import Settings

STAND_AS = (Transform, Motion, RigidBody, Force, Flight)
#: What acts on particles, in the order of the step; the others need to know how a body is turned, or who else is there.
FIELDS = (
    choose_bodies,
    clear_forces,
    apply_wind,
    apply_vortex,
    apply_gravity,
    apply_gravity_well,
    apply_attraction,
    apply_linear_drag,
    apply_quadratic_drag,
    apply_constant_push,
)


class Even(NamedTuple):
    """What is the same for all particles of an emitter: acceleration, drag by mass (1/s, and 1/m of u^2), flow."""

    acceleration: Floats
    drag: float
    pace: float
    flow: Floats


class StandIn(World):
    """A world of a chunk of bodies, of which the first ``shown`` are there."""

    def __init__(self) -> None:
        super().__init__(capacity=CHUNK)
        self.spawn_many(CHUNK, *(kind() for kind in STAND_AS))
        self.shown = CHUNK
        self._numbers = np.arange(CHUNK)
        for resource in (Progress(), Awake()):
            self.add(resource)

    def row_numbers(self, *kinds: type[Component], **options: Any) -> Integers:
        """Return the rows of the particles that stand here, none for what particles do not have."""
        return self._numbers[: self.shown if set(kinds) <= set(STAND_AS) else 0]

    def rows(self, *kinds: type[Component], **options: Any) -> slice:
        """Return the same as a slice."""
        return slice(0, len(self.row_numbers(*kinds)))


class Fields(Resource):
    """The stand-in, made when it is first needed, the user's functions, and room for the arcs of a chunk; a cache."""

    def __init__(self) -> None:
        self.arcs = aligned(ARC_ROWS * CHUNK // WIDTH, WIDTH)
        self.functions: list[System] = []
        self._stand: StandIn | None = None

    def even(self, world: World, emitter: int, row: int, time: float) -> Even | None:
        """Return what acts at a time (s) on the particles of an emitter, None where that depends on where they are."""
        laws = [(law, there) for law, there in _laws(world, emitter, time) if there is not NOWHERE]
        if self.functions or not all(
            isinstance(law, EVEN) and law.steady and there.region is None for law, there in laws
        ):
            return None
        table, gravity = world[Emitter], np.array(world[Settings].gravity)
        mass, flow, drag, pace = float(table.mass[row]), np.zeros(3), 0.0, 0.0
        for law, _ in laws:
            if isinstance(law, Wind):
                flow += law.velocity
            elif isinstance(law, LinearDrag):
                drag += law.coefficient
            elif isinstance(law, QuadraticDrag):
                pace += law.factor
        return Even(gravity * table.gravity_scale[row], drag / mass, pace / mass, flow)

    def lay(self, world: World, emitter: int, row: int, first: int, times: Floats, dt: float, arcs: Floats) -> None:
        """Lay the arcs of a chunk of particles, rows from ``first`` on, that fly for ``times`` (n,), s."""
        stand = self._stand = self._stand or StandIn()
        count, clock = len(times), (world.frame - 1) * dt
        self._place(world, stand, row, first, times)
        laws = Forces()
        for law, there in _laws(world, emitter, clock + 0.5 * dt):
            laws.add(law, there)
        stand.add(laws)
        stand.add(world[Settings])
        stand[Progress].clock = clock
        stand[Awake].rows, stand[Awake].found = stand.row_numbers(), stand.structure
        with stand.faces(None):
            for system in (*FIELDS, *self.functions):
                system(stand, dt)
            force = stand[Force]
            mass = float(world[Emitter].mass[row])
            lay_arcs(times, 1.0 / mass, force.force[:count], force.drag[:count], force.drag_flow[:count], arcs)

    def _place(self, world: World, stand: StandIn, row: int, first: int, times: Floats) -> None:
        """Let particles stand as bodies where they will be in the middle of their flight, as fast as gravity makes."""
        emitter, particle, stand.shown = world[Emitter], world[Particle], len(times)
        rows, here = slice(first, first + len(times)), slice(0, len(times))
        with stand.faces(None):
            place, motion, body, flight = stand[Transform], stand[Motion], stand[RigidBody], stand[Flight]
            flight.start_center[here], flight.start_linear[here] = particle.position(rows), particle.velocity(rows)
            half = 0.5 * times[:, None]
            fall = np.array(world[Settings].gravity) * emitter.gravity_scale[row]
            place.position[here] = flight.start_center[here] + half * flight.start_linear[here]
            motion.linear[here] = flight.start_linear[here] + half * fall
            body.mass[here], body.inverse_mass[here] = emitter.mass[row], 1.0 / emitter.mass[row]
            body.gravity_scale[here] = emitter.gravity_scale[row]


EVEN = (Wind, LinearDrag, QuadraticDrag)
NOWHERE = Reach(entities=())


def _laws(world: World, emitter: int, time: float) -> Iterator[tuple[Law, Reach]]:
    """Yield every law with where it acts on the particles of an emitter at a time (s).

    Those of no entities in particular do, and those of the emitter; particles are on no layer. Also those that act
    nowhere are told, so that each is the same in number as for bodies, which gusts depend on.
    """
    for entries in world[Forces].entries.values():
        for law, reach in entries:
            named = reach.entities is None or emitter in reach.entities
            acts = named and reach.layers is None and reach.acts_at(time)
            yield law, Reach(region=reach.region) if acts else NOWHERE
