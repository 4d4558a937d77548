"""Sleep state: who is awake, who might fall asleep, who sleeps, and who keeps whom awake; for observers."""

from __future__ import annotations

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.systems.kernels.islands import find_surface_speeds
from carom.systems.settings import Settings

#: Eligible is who has been slow enough to fall asleep, once all of its island have been so for long enough.
STATES = ("static", "awake", "eligible", "asleep")


def pushed_bodies(world: World) -> Integers:
    """Return the rows of the bodies that can be pushed, which alone fall asleep."""
    rows = world.row_numbers(Transform, Motion, RigidBody)
    return np.asarray(rows[world[RigidBody].inverse_mass[rows] > 0.0])


def sleep_states(world: World, bodies: Integers) -> Integers:
    """Return the place in STATES (n,) of bodies (rows; -1 for what has no body)."""
    motion, may = world[Motion], world[Settings].sleeping
    moving = np.where(motion.asleep[bodies], 3, np.where(may & (motion.still[bodies] > 0.0), 2, 1))
    return np.where(bodies < 0, 0, moving)


def surface_speeds(world: World, rows: Integers) -> Floats:
    """Return how fast (m/s) the fastest point of each body (rows) is, as falling asleep counts it."""
    body, motion = world[RigidBody], world[Motion]
    speed: Floats = np.zeros(len(body.mass))
    find_surface_speeds(rows, body.inverse_mass, body.inertia, motion.linear, motion.angular, speed)
    return np.asarray(speed[rows])


def most_restless(world: World, rows: Integers, island: Integers) -> Integers:
    """Return for each body (rows) who of its island has been still for the shortest time, the fastest of several.

    ``island`` (n,) is any number that those of an island share.
    """
    order = np.lexsort((-surface_speeds(world, rows), world[Motion].still[rows], island))
    islands, first = np.unique(island[order], return_index=True)
    return np.asarray(rows[order[first]][np.searchsorted(islands, island)])
