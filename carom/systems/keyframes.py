"""Keyframes: kinematic bodies that are at given poses at given times."""

from __future__ import annotations

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World, system
from carom.ecs.column import Floats, Integers
from carom.ecs.components.path import Path
from carom.ecs.relations.keyframe import Keyframe
from carom.ecs.spatial import quaternion
from carom.systems.kernels.keyframes import find_moments


@system(reads=(Path, Keyframe, RigidBody, Transform), writes=(Motion,))
def follow_keyframes(world: World, dt: float) -> None:
    """Give bodies on keyframes the velocity that takes them to their pose at the end of the step."""
    rows = world.row_numbers(Path, RigidBody, Motion, Transform)
    if not len(rows):
        return
    transform, motion, arm = world[Transform], world[Motion], world[RigidBody].center_of_mass[rows]
    path, position, rotation = world[Path], transform.position[rows], transform.rotation[rows]
    to, turned = poses_at(world[Keyframe], rows, world.frame * dt, path.first, path.count, path.repeat)
    way = to + quaternion.rotate(turned, arm) - (position + quaternion.rotate(rotation, arm))
    axis, angle = quaternion.to_axis_angle(quaternion.multiply(turned, quaternion.conjugate(rotation)))
    motion.linear[rows], motion.angular[rows] = way / dt, axis * (angle / dt)[:, None]


def poses_at(
    keyframe: Keyframe, rows: Integers, time: float, first: Integers, count: Integers, repeat: Integers
) -> tuple[Floats, Floats]:
    """Return positions (n, 3) in m and rotations (n, 4) at a time (s) of the paths in these rows.

    A path is ``count`` keyframes from ``first`` on, gone along as `Repeat` says.
    """
    before, share = np.zeros(len(rows), np.int64), np.zeros(len(rows))
    find_moments(rows, time, first, count, repeat, keyframe.at, before, share)
    start, end = keyframe.position[before], keyframe.position[before + 1]
    turned = quaternion.slerp(keyframe.rotation[before], keyframe.rotation[before + 1], share)
    return start + share[:, None] * (end - start), turned
