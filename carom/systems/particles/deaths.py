"""Deaths: particles go by age, where they leave their part of space, and where there are too many."""

from __future__ import annotations

import numpy as np

from carom.ecs import World, system
from carom.ecs.column import Booleans
from carom.ecs.components.emitter import Emitter, Within
from carom.ecs.relations.particle import Particle
from carom.systems.forces.region import BoxRegion, SphereRegion
from carom.systems.particles.pieces import Piece, pieces, remove
from carom.systems.settings import Settings, time_of


@system(reads=(Settings, Emitter), writes=(Particle,))
def end_particles(world: World, dt: float) -> None:
    """Take out particles whose time is over, who have left their part of space, and the oldest of too many.

    Of an emitter that is no more all go.
    """
    count = world.count(Particle)
    if not count:
        return
    gone: Booleans = world[Particle].dies[:count] <= time_of(world)
    for piece in pieces(world):
        if piece.emitter not in world:
            gone[piece.rows] = True
            continue
        row = world.row(piece.emitter)
        if world[Emitter].within[row] != Within.ANYWHERE:
            gone[piece.rows] |= ~region_of(world[Emitter], row).contains(world[Particle].position(piece.rows))
        if world[Emitter].most[row]:
            gone[piece.rows] |= oldest(world[Particle], piece, gone[piece.rows], int(world[Emitter].most[row]))
    if gone.any():
        remove(world, gone)


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
