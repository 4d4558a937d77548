"""Moving: particles along their arcs, a step at a time; they push nobody, and so need no substeps."""

from __future__ import annotations

import numpy as np

from carom.ecs import World, system
from carom.ecs.column import Floats
from carom.ecs.components.emitter import Collide, Emitter
from carom.ecs.errors import NonFiniteError
from carom.ecs.relations.particle import PLACE, VELOCITY, Particle
from carom.systems.forces.law import Forces
from carom.systems.kernels.lanes import WIDTH
from carom.systems.kernels.particle_arcs import ARC_ROWS, CHUNK, lay_even_arcs
from carom.systems.kernels.particle_flight import fly
from carom.systems.particles.fields import Even, Fields
from carom.systems.particles.newborn import Newborn
from carom.systems.particles.obstacles import NO_PLANES, READ_BY_OBSTACLES, bounce_off_colliders, planes
from carom.systems.particles.pieces import emitter_row, pieces
from carom.systems.queries.space import ASKED
from carom.systems.settings import Settings, time_of

READS = tuple(dict.fromkeys((Emitter, Forces, Settings, Newborn, *READ_BY_OBSTACLES, *ASKED)))


@system(reads=READS, writes=(Particle, Fields))
def move_particles(world: World, dt: float) -> None:
    """Fly particles through the step, newborn ones through what is left of it."""
    for piece in pieces(world):
        row = emitter_row(world, piece)
        if row is None:
            continue
        old = piece.size - world[Newborn].counts.get(piece.emitter, 0)
        even = world[Fields].even(world, piece.emitter, row, time_of(world) - 0.5 * dt)
        collide = int(world[Emitter].collide[row])
        flight = Flight(world, piece.emitter, row, even, NO_PLANES if collide == Collide.NONE else planes(world, row))
        at_once = CHUNK if even is None or collide == Collide.ALL else max(old, 1)  # what is even is laid but once
        for first in range(0, old, at_once):
            count = min(at_once, old - first)
            flight.fly(piece.first + first, count, np.full(min(count, CHUNK), dt), dt)
        particle = world[Particle]
        for first in range(piece.first + old, piece.first + piece.size, CHUNK):
            rows = slice(first, min(first + CHUNK, piece.first + piece.size))
            times = np.maximum(time_of(world) - (particle.dies[rows] - particle.life[rows]), 0.0)
            flight.fly(first, len(times), times, dt)


def refuse_not_finite(world: World, rows: slice) -> None:
    """Raise NonFiniteError for the first particle whose place or velocity is not finite."""
    particle = world[Particle]
    for name in PLACE + VELOCITY:
        values = getattr(particle, name)[rows]
        wrong = values[~np.isfinite(values)]
        if len(wrong):
            emitter = world.name(int(particle.emitter[rows.start]))
            raise NonFiniteError(world.frame, f"Particle.{name}", emitter, str(wrong[0]), "after 'move_particles'")


class Flight:
    """How the particles of one emitter fly in this step."""

    def __init__(self, world: World, emitter: int, row: int, even: Even | None, obstacles: Floats) -> None:
        self.world, self.emitter, self.row, self.even, self.planes = world, emitter, row, even, obstacles
        self._room = np.zeros(len(VELOCITY + PLACE) * WIDTH, np.float32)
        self._arcs = world[Fields].arcs
        self._flat = self._arcs.reshape(ARC_ROWS, CHUNK)

    def fly(self, first: int, count: int, times: Floats, dt: float) -> None:
        """Fly ``count`` particles, rows from ``first`` on; ``times`` (s) are those of a chunk, and of all after it."""
        if not count:
            return
        world, even, particle = self.world, self.even, self.world[Particle]
        if even is None:
            world[Fields].lay(world, self.emitter, self.row, first, times, dt, self._flat)
        else:
            lay_even_arcs(times, even.drag, *even.acceleration, *even.flow, self._flat)
        whole = world[Emitter].collide[self.row] == Collide.ALL
        rows = slice(first, first + count)
        before = particle.position(rows) if whole else None
        sound = fly(
            first, count, self._arcs, 0.5 * even.pace if even is not None else 0.0, self.planes, self._room,
            *(getattr(particle, name) for name in PLACE + VELOCITY),
        )  # fmt: skip
        if not sound:
            refuse_not_finite(world, rows)
        if before is not None:
            bounce_off_colliders(world, self.row, rows, before, times, self.planes)
