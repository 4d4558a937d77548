"""Fields: forces on particles, by the very systems that apply them to bodies.

A chunk of particles stands in as bodies; there a user's Python function acts on particles as it is, too. Where only
gravity, even winds and drags act, which are the same for all particles of an emitter, nobody needs to stand anywhere.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from carom.ecs import Motion, RigidBody, System, Transform, World
from carom.ecs.column import Floats
from carom.ecs.component import Resource
from carom.ecs.components.emitter import Emitter
from carom.ecs.components.flight import Flight
from carom.ecs.relations.particle import Particle
from carom.systems.forces.drag import LinearDrag, QuadraticDrag
from carom.systems.forces.law import Law
from carom.systems.forces.reach import Reach
from carom.systems.forces.stand_in import NOWHERE, StandIn, felt_laws
from carom.systems.forces.wind import Wind
from carom.systems.kernels.lanes import WIDTH, aligned
from carom.systems.kernels.particle_arcs import ARC_ROWS, CHUNK, lay_arcs
from carom.systems.settings import Settings


class Even(NamedTuple):
    """What is the same for all particles of an emitter: acceleration, drag by mass (1/s, and 1/m of u^2), flow."""

    acceleration: Floats
    drag: float
    pace: float
    flow: Floats


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
        stand = self._stand = self._stand or StandIn(CHUNK)
        count, clock = len(times), (world.frame - 1) * dt
        self._place(world, stand, row, first, times)
        laws = _laws(world, emitter, clock + 0.5 * dt)
        force = stand.feel(laws, world[Settings], clock, dt, self.functions)
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


def _laws(world: World, emitter: int, time: float) -> Iterator[tuple[Law, Reach]]:
    """Yield the laws as they act on the particles of an emitter at a time (s).

    Those of no entities in particular do, and those of the emitter; particles are on no layer.
    """

    def felt(law: Law, reach: Reach) -> bool:
        return (reach.entities is None or emitter in reach.entities) and reach.layers is None

    return felt_laws(world, time, felt)
