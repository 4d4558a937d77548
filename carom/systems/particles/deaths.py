"""Deaths: particles go by age, where they leave their part of space, and where there are too many."""

from __future__ import annotations

import numpy as np

from carom.ecs import World, system
from carom.ecs.column import Booleans
from carom.ecs.components.emitter import Emitter, Within
from carom.ecs.relations.particle import Particle
from carom.systems.forces.region import BoxRegion, SphereRegion
from carom.systems.kernels.particle_deaths import any_due
from carom.systems.particles.pieces import Piece, emitter_row, pieces, remove
from carom.systems.settings import Settings, time_of


@system(reads=(Settings, Emitter), writes=(Particle,))
def end_particles(world: World, dt: float) -> None:
    """Take out particles whose time is over, who have left their part of space, and the oldest of too many.

    Of an emitter that is no more all go.
    """
    if not world.count(Particle):
        return
    doomed = [(piece.rows, going) for piece in pieces(world) if (going := leaving(world, piece)) is not None]
    if doomed:
        gone: Booleans = np.zeros(world.count(Particle), np.bool_)
        for rows, going in doomed:
            gone[rows] = going
        remove(world, gone)


def leaving(world: World, piece: Piece) -> Booleans | None:
    """Return which of a piece must go, None where it is nobody."""
    row, emitter, particle, time = emitter_row(world, piece), world[Emitter], world[Particle], time_of(world)
    if row is None:
        return np.ones(piece.size, np.bool_)
    bounded, most = emitter.within[row] != Within.ANYWHERE, int(emitter.most[row])
    if not (bounded or 0 < most < piece.size or any_due(particle.dies, piece.first, piece.size, time)):
        return None  # as in most steps
    going: Booleans = particle.dies[piece.rows] <= time
    if bounded:
        going |= ~region_of(emitter, row).contains(particle.position(piece.rows))
    if most:
        going |= oldest(particle, piece, going, most)
    return going if going.any() else None


def region_of(emitter: Emitter, row: int) -> BoxRegion | SphereRegion:
    """Return the part of space that an emitter's particles may be in."""
    position, extent = tuple(emitter.within_position[row].tolist()), tuple(emitter.within_extent[row].tolist())
    if emitter.within[row] == Within.BOX:
        return BoxRegion(size=extent, position=position)
    return SphereRegion(radius=extent[0], position=position)


def oldest(particle: Particle, piece: Piece, gone: Booleans, most: int) -> Booleans:
    """Return which of a piece must go so that ``most`` stay beside those who are ``gone`` anyway."""
    left = np.nonzero(~gone)[0]
    surplus = len(left) - most
    going = np.zeros(len(gone), np.bool_)
    if surplus > 0:
        numbers = particle.number[piece.rows][left]
        going[left[np.argpartition(numbers, surplus - 1)[:surplus]]] = True
    return going
