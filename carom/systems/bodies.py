"""Bodies: which of them obey forces, and where their centres of mass are."""

from __future__ import annotations

import numpy as np

from carom.ecs import BodyType, Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion


def dynamic_rows(world: World) -> Integers:
    """Return the rows of the bodies that obey forces."""
    rows = world.row_numbers(Transform, Motion, RigidBody)
    return np.asarray(rows[world[RigidBody].type[rows] == BodyType.DYNAMIC])


def centers_of_mass(world: World, rows: Integers, poses: Transform | None = None) -> Floats:
    """Return centres of mass (n, 3) in m, world frame, now or at other poses of all rows."""
    transform = world[Transform] if poses is None else poses
    offset = quaternion.rotate(transform.rotation[rows], world[RigidBody].center_of_mass[rows])
    return np.asarray(transform.position[rows] + offset)
