"""Who a joint holds: of each of the two their pose, and the body that carries it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from carom.ecs import Parent, RigidBody, Transform, World
from carom.ecs.column import Floats
from carom.ecs.errors import EntityError, did_you_mean
from carom.ecs.spatial import quaternion
from carom.systems.parameters import WordFault

WORLD = -1
MOST_NAMED = 12  # names that a message lists


class Held(NamedTuple):
    """One of the two: handle (-1 for the world), pose, and 1/kg, which is 0 for what no force moves."""

    entity: int = WORLD
    position: Floats = np.zeros(3)
    rotation: Floats = np.array(quaternion.IDENTITY)
    inverse_mass: float = 0.0

    def inside(self, point: Any) -> Floats:
        """Return a point of the world in the frame of this one, m."""
        return quaternion.rotate(quaternion.conjugate(self.rotation), np.asarray(point, np.float64) - self.position)

    def outside(self, point: Any) -> Floats:
        """Return a point in the frame of this one in the world, m."""
        return self.position + quaternion.rotate(self.rotation, point)


def find_held(world: World, whom: Any) -> Held | WordFault:
    """Return who is meant by a name, a handle or None, or what is wrong with that.

    Where a body carries who is meant, it is that body.
    """
    if whom is None:
        return Held()
    try:
        row = world.row(world.find(whom) if isinstance(whom, str) else int(whom))
    except EntityError as fault:
        return WordFault((), str(fault)) if not isinstance(whom, str) else unknown(whom, world.names())
    bodies, carried, placed = (world.table(kind).present for kind in (RigidBody, Parent, Transform))
    if not placed[row]:
        return WordFault((), f"'{world.name(world.entity(row))}' is at no place; hold what has a transform")
    carrier, passed = row, set[int]()
    while carried[carrier] and not bodies[carrier] and carrier not in passed:  # a circle is told of when it is placed
        passed.add(carrier)
        carrier = world.row(int(world[Parent].entity[carrier]))
    row = carrier if bodies[carrier] else row
    inverse_mass = float(world[RigidBody].inverse_mass[row]) if bodies[row] else 0.0
    pose = world[Transform]
    return Held(int(world.entity(row)), pose.position[row].copy(), pose.rotation[row].copy(), inverse_mass)


def unknown(name: str, names: Iterable[str]) -> WordFault:
    """Return the fault of a name that nothing is called."""
    known = list(names)
    listed = ", ".join(known[:MOST_NAMED]) + (", ..." if len(known) > MOST_NAMED else "")
    return WordFault((), "unknown entity", repr(name), listed or "none is defined", did_you_mean(name, known), name)
