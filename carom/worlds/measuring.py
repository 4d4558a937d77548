"""Measuring: how large some entities are together, as they would be in a world of their own."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.errors import CaromError
from carom.ecs.hierarchy import compose
from carom.ecs.spatial import quaternion
from carom.systems.compound import bound_centers
from carom.worlds.amounts import few_enough
from carom.worlds.populate import Populator
from carom.worlds.unfold import Item


def measured(populator: Populator, items: list[Item]) -> tuple[Floats, Floats] | None:
    """Return the lowest and highest corners (3,), m, of the box around entities, having added them to a world.

    None where nothing has a collider, where one has no end, and where something is wrong, which is reported.
    """
    source, world = populator.intake.source, populator.simulation.world
    told = len(source.faults)
    if not few_enough(source, items):
        return None
    populator.add_all(items)
    if len(source.faults) > told:
        return None
    populator.intake.connections.point_all()
    try:
        compose(world)
    except CaromError as fault:
        source.report(items[0].path, str(fault))
        return None
    low, high = boxes(world, world.row_numbers(Collider, Transform))
    if not len(low) or not (np.isfinite(low).all() and np.isfinite(high).all()):
        return None
    return low.min(axis=0), high.max(axis=0)


def boxes(world: World, rows: Integers) -> tuple[Floats, Floats]:
    """Return the lowest and highest corners (n, 3), m, of boxes along the axes of the world around colliders (rows).

    Those of shapes without end are infinite.
    """
    collider, middle, turn = world[Collider], bound_centers(world, rows), world[Transform].rotation[rows]
    with np.errstate(invalid="ignore"):
        half = (np.abs(quaternion.matrix(turn)) * collider.bound_half[rows][:, None, :]).sum(axis=-1)
    half = np.where(np.isfinite(half), half, np.inf) + collider.bound_radius[rows][:, None]
    return middle - half, middle + half
