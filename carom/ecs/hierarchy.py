"""Hierarchy: poses of children from those of their parents, and everyone below an entity."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.components.parent import Parent
from carom.ecs.components.transform import Transform
from carom.ecs.errors import EntityError
from carom.ecs.spatial import quaternion

if TYPE_CHECKING:
    from carom.ecs.structure import Structure
    from carom.ecs.world import World


def compose(world: World, children: Integers | None = None) -> None:
    """Place children (rows; default all) where their parents carry them, those nearest to the root first.

    The pose in the world is the parent's followed by the one in its frame: x = x_p + q_p x_l, q = q_p q_l. Raises
    EntityError when a parent has no Transform or entities carry each other in a circle.
    """
    rows = world.row_numbers(Parent, Transform) if children is None else children
    if not len(rows):
        return
    with world.edit(Transform) as transform:
        carry(world, rows, transform.position, transform.rotation)


def carry(world: World, children: Integers, position: Floats, rotation: Floats) -> None:
    """Write into the columns of poses where children (rows) are, given where those who carry them are there."""
    parent = world[Parent]
    for level in levels(world, children):
        carriers = world.slots.rows(parent.entity[level])
        turn = rotation[carriers]
        position[level] = position[carriers] + quaternion.rotate(turn, parent.position[level])
        rotation[level] = quaternion.multiply(turn, parent.rotation[level])


def levels(world: World, rows: Integers) -> list[Integers]:
    """Return ``rows`` of children in groups, each carried by entities that stand in no later group."""
    if not len(rows):
        return []
    carriers = world[Parent].entity[rows]
    if (carriers < 0).any():
        child = world.name(world.entity(rows[np.argmin(carriers)]))
        raise EntityError(f"entity '{child}' has a parent component but no parent; set parent.entity, or detach it")
    parents = world.slots.rows(carriers)
    rootless = ~world.table(Transform).present[parents]
    if rootless.any():
        child, carrier = rows[rootless][0], parents[rootless][0]
        names = world.name(world.entity(child)), world.name(world.entity(carrier))
        raise EntityError(f"entity '{names[0]}' is carried by '{names[1]}', which has no transform; give it one")
    waiting = np.zeros(world.used(), np.bool_)
    waiting[rows] = True
    found = []
    while len(rows):
        ready = ~waiting[parents]
        if not ready.any():
            circle = ", ".join(repr(world.name(world.entity(row))) for row in rows[:8])
            raise EntityError(f"entities carry each other in a circle: {circle}; detach one from its parent")
        found.append(rows[ready])
        waiting[rows[ready]] = False
        rows, parents = rows[~ready], parents[~ready]
    return found


def descendants(world: Structure, entities: Integers) -> Integers:
    """Return the entities and everyone they carry, directly or through others."""
    table = world.table(Parent)
    rows = np.nonzero(table.present[: world.used()])[0]
    if not len(rows):
        return entities
    carriers, children = table.arrays["entity"][rows], world.entities(rows)
    family = np.unique(entities)
    while True:
        larger = np.union1d(family, children[np.isin(carriers, family)])
        if len(larger) == len(family):
            return larger
        family = larger
