"""Pushes: impulses that are given at once, between two flights of a body."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.systems.awake import ask_to_wake
from carom.systems.kernels.turning import find_turning


class Pushes(NamedTuple):
    """Impulses (n, 3), N s, and angular ones about centres of mass (n, 3), N m s, of ``name`` on bodies (rows).

    ``point`` (n, 3), m, is where each acts; all are in the frame of the world.
    """

    name: str
    rows: Integers
    impulse: Floats
    twist: Floats
    point: Floats


def push(world: World, pushes: Pushes) -> None:
    """Give dynamic bodies, each of which is there once, the velocities that impulses make; locked axes stay locked.

    Who sleeps is woken before the next step.
    """
    rows, body, motion = pushes.rows, world[RigidBody], world[Motion]
    turning: Floats = np.empty((len(rows), 3))
    find_turning(
        rows, np.ascontiguousarray(pushes.twist), body.inverse_inertia, body.principal_axes, body.freedom,
        world[Transform].rotation, turning,
    )  # fmt: skip
    motion.linear[rows] += body.inverse_mass[rows, None] * body.freedom[rows, :3] * pushes.impulse
    motion.angular[rows] += turning
    ask_to_wake(motion, rows)
