"""Emission: when particles are born, and where their emitters are then."""

from __future__ import annotations

from math import ceil, floor

import numpy as np

from carom.ecs import Motion, Parent, RigidBody, Transform, World, system
from carom.ecs.column import Floats, Integers
from carom.ecs.components.emitter import Emitter
from carom.ecs.errors import DeclarationError
from carom.ecs.relations.particle import Particle
from carom.ecs.spatial import quaternion, vector
from carom.ecs.spatial.trigonometry import sine_cosine
from carom.systems.compound import bodies_of
from carom.systems.constants import MOST_BORN
from carom.systems.kernels.particle_births import WORD, bear
from carom.systems.particles.newborn import Newborn
from carom.systems.particles.pieces import make_room
from carom.systems.settings import Settings, time_of


@system(reads=(Transform, Motion, RigidBody, Parent), writes=(Emitter,))
def note_emitters(world: World, dt: float) -> None:
    """Note where emitters are, and how fast, at the start of the step."""
    rows = world.row_numbers(Emitter, Transform)
    if len(rows):
        emitter, transform = world[Emitter], world[Transform]
        emitter.start_position[rows] = transform.position[rows]
        emitter.start_rotation[rows] = transform.rotation[rows]
        emitter.start_linear[rows], emitter.start_angular[rows] = velocities(world, rows)


@system(reads=(Transform, Motion, RigidBody, Parent, Settings), writes=(Emitter, Particle, Newborn))
def emit_particles(world: World, dt: float) -> None:
    """Bring forth what is born within the step, each at its own time."""
    newborn = world[Newborn]
    newborn.counts = {}
    rows = world.row_numbers(Emitter, Transform)
    if not len(rows):
        return
    emitter, transform, end = world[Emitter], world[Transform], time_of(world)
    begin, births = (world.frame - 1) * dt, dict[int, tuple[int, Floats]]()
    refuse_crowds(world, rows, dt)
    for row in rows.tolist():
        times = due(emitter, row, begin, end)
        if len(times):
            births[int(world.entity(row))] = (row, times)
    if not births:
        return
    newborn.counts = {handle: len(times) for handle, (_, times) in births.items()}
    rooms, seed = make_room(world, newborn.counts), world[Settings].seed & WORD
    linear, angular = velocities(world, rows)
    particle, place = world[Particle], {row: number for number, row in enumerate(rows.tolist())}
    for handle, (row, times) in births.items():
        bear(
            rooms[handle], times, begin, dt, seed, handle, int(emitter.born[row]), row,
            emitter.source, emitter.extent, emitter.direction, sine_cosine(float(emitter.cone[row]))[1],
            emitter.speed, emitter.life, emitter.inherit,
            emitter.start_position, emitter.start_rotation, emitter.start_linear, emitter.start_angular,
            transform.position, transform.rotation, linear[place[row]], angular[place[row]],
            particle.emitter, particle.number, particle.dies, particle.life, particle.x, particle.y, particle.z,
            particle.velocity_x, particle.velocity_y, particle.velocity_z,
        )  # fmt: skip
        emitter.born[row] += len(times)


def refuse_crowds(world: World, rows: Integers, dt: float) -> None:
    """Raise DeclarationError for an emitter that brings forth more than `MOST_BORN` in a step."""
    emitter = world[Emitter]
    rate, burst, every = emitter.rate[rows], emitter.burst[rows], emitter.every[rows]
    bursts = np.divide(dt, every, out=np.zeros(len(rows)), where=every > 0.0) + 1.0
    born = rate * dt + burst * bursts
    if not (born <= MOST_BORN).all():
        worst = int(np.argmax(born))
        raise DeclarationError(
            f"emitter of '{world.name(world.entity(int(rows[worst])))}' brings forth {born[worst]:.3g} particles in a "
            f"step, more than {MOST_BORN:,}; lower its rate or burst, or step.dt"
        )


def due(emitter: Emitter, row: int, begin: float, end: float) -> Floats:
    """Return the times (n,), s, of births from ``begin`` to before ``end``, and count them in the emitter's phase.

    Between two births lies 1 / rate, before the first half of that: of how many no rounding decides.
    """
    start, every = float(emitter.start[row]), float(emitter.every[row])
    stop = min(end, start + float(emitter.duration[row]))
    times = []
    if emitter.burst[row]:
        first = max(0, ceil((begin - start) / every)) if every else 0
        last = ceil((stop - start) / every) if every else 1
        moments = [start + number * every for number in range(first, last)]
        times += [time for time in moments if begin <= time < stop for _ in range(int(emitter.burst[row]))]
    if emitter.rate[row] > 0.0 and stop > (since := max(begin, start)):
        phase, rate = float(emitter.phase[row]), float(emitter.rate[row])
        count = floor(phase + rate * (stop - since))
        emitter.phase[row] = phase + rate * (stop - since) - count
        times += [since + (number - phase) / rate for number in range(1, count + 1)]
    return np.array(times)


def velocities(world: World, rows: Integers) -> tuple[Floats, Floats]:
    """Return velocities of the origins of entities (n, 3) and their angular velocities: of their bodies, else 0."""
    linear, angular = np.zeros((len(rows), 3)), np.zeros((len(rows), 3))
    body = bodies_of(world)[rows]
    carried = np.nonzero(body >= 0)[0]
    if len(carried):
        at, by = rows[carried], body[carried]
        transform, motion = world[Transform], world[Motion]
        center = transform.position[by] + quaternion.rotate(transform.rotation[by], world[RigidBody].center_of_mass[by])
        angular[carried] = motion.angular[by]
        linear[carried] = motion.linear[by] + vector.cross(motion.angular[by], transform.position[at] - center)
    return linear, angular
