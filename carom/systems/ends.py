"""Ends: who joints and springs are between."""

from __future__ import annotations

import numpy as np

from carom.ecs import World
from carom.ecs.column import Integers
from carom.ecs.components.joint import Joint
from carom.ecs.components.spring import Spring


def ends_there(world: World, kind: type[Joint] | type[Spring]) -> tuple[Integers, Integers, Integers]:
    """Return the rows (n,) of those whose ends are both there, and the rows of a and of b, -1 for the world."""
    rows = world.row_numbers(kind)
    if not len(rows):  # most worlds, in every substep
        return rows, rows, rows
    a, b = world[kind].a[rows], world[kind].b[rows]
    row_a, row_b = _rows_of(world, a), _rows_of(world, b)
    there = ((a < 0) | (row_a >= 0)) & ((b < 0) | (row_b >= 0))
    return rows[there], row_a[there], row_b[there]


def _rows_of(world: World, entities: Integers) -> Integers:
    """Return the rows of handles, -1 for the world and for who is gone."""
    rows: Integers = np.full(len(entities), -1)
    live = world.slots.live(entities)
    rows[live] = world.slots.rows(entities[live])
    return rows
