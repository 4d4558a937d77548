"""Pieces: the rows of the particle table that belong to one emitter, kept together as particles come and go."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from carom.ecs import World
from carom.ecs.column import Booleans, Integers
from carom.ecs.components.emitter import Emitter
from carom.ecs.relations.particle import Particle


class Piece(NamedTuple):
    """The particles of one emitter, a handle: ``size`` rows from ``first`` on."""

    emitter: int
    first: int
    size: int

    @property
    def rows(self) -> slice:
        """Its rows."""
        return slice(self.first, self.first + self.size)


def emits(world: World) -> bool:
    """Tell whether there are particles, or something that may bring them forth."""
    return world[Particle].count > 0 or len(world.row_numbers(Emitter)) > 0


def pieces(world: World) -> list[Piece]:
    """Return the pieces that are there, in order."""
    count = world.count(Particle)
    emitter, found, first = world[Particle].emitter[:count], list[Piece](), 0
    while first < count:
        handle = int(emitter[first])
        last = int(np.searchsorted(emitter, handle, "right"))
        found.append(Piece(handle, first, last - first))
        first = last
    return found


def emitter_row(world: World, piece: Piece) -> int | None:
    """Return the row of the emitter of a piece, None where it is no more."""
    row = world.row(piece.emitter) if piece.emitter in world else None
    return row if row is not None and world.table(Emitter).present[row] else None


def piece_of(world: World, emitter: int) -> Piece:
    """Return the piece of an emitter, without rows where it has no particles."""
    handles = world[Particle].emitter[: world.count(Particle)]
    first, last = np.searchsorted(handles, emitter, "left"), np.searchsorted(handles, emitter, "right")
    return Piece(emitter, int(first), int(last - first))


def make_room(world: World, births: Mapping[int, int]) -> dict[int, int]:
    """Lengthen pieces by how many each emitter brings forth; return the first new row of each.

    Pieces behind are not moved: what is in the way goes to the other end of its own.
    """
    there = {piece.emitter: piece for piece in pieces(world)}
    world.resize(Particle, world.count(Particle) + sum(births.values()))
    shift, moves, rooms = 0, list[tuple[Piece, int]](), dict[int, int]()
    end = 0
    for emitter in sorted({*there, *births}):
        piece = there.get(emitter, Piece(emitter, end, 0))
        end = piece.first + piece.size
        moves.append((piece, shift))
        if emitter in births:
            rooms[emitter] = end + shift
            shift += births[emitter]
    for piece, shift in reversed(moves):
        count = min(piece.size, shift)
        last = piece.first + piece.size + shift
        _move(world, slice(piece.first, piece.first + count), slice(last - count, last))
    return rooms


def remove(world: World, gone: Booleans) -> None:
    """Take out the rows that are ``gone`` (n,): the last of a piece take their place, and pieces behind close up."""
    end = 0
    for piece in pieces(world):
        leaving = np.nonzero(gone[piece.rows])[0]
        kept = piece.size - len(leaving)
        holes = piece.first + leaving[leaving < kept]
        last = np.nonzero(~gone[piece.first + kept : piece.first + piece.size])[0] + piece.first + kept
        _move(world, last, holes)
        count = min(kept, piece.first - end)
        _move(world, slice(piece.first + kept - count, piece.first + kept), slice(end, end + count))
        end += kept
    world.resize(Particle, end)


def _move(world: World, source: slice | Integers, target: slice | Integers) -> None:
    arrays = world[Particle]
    size = source.stop - source.start if isinstance(source, slice) else len(source)
    if size:
        for name in Particle.columns:
            column = getattr(arrays, name)
            column[target] = column[source]
