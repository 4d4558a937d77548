"""Many joints at once, all alike but for whom they hold and where."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from carom.ecs import Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.components.joint import LINE, Joint
from carom.ecs.spatial import quaternion
from carom.systems.joints.kind import JOINTS
from carom.systems.joints.point_joint import PointJoint
from carom.systems.joints.stating import joint_of


def join_many(
    world: World, joint: Mapping[str, Any], a: Integers, b: Integers, at: Floats, names: list[str] | None = None
) -> Integers:
    """Hold bodies ``b`` (n,) to bodies ``a`` (n,), handles, at points (n, 3), m, world frame; return the joints (n,).

    ``joint`` are the words of one, ``{"hinge": {"axis": (0, 0, 1)}}``: as it lies against its b in the first pair, so
    it does in all. Joints along a line go from origin to origin, unless they state anchors, and are as long as the
    first. Raises DeclarationError for words that are no joint of the first pair.
    """
    if not len(a):
        return np.zeros(0, np.int64)
    kinds = {key: dict(words) for key, words in joint.items()}
    for key, words in kinds.items():
        words |= {"a": int(a[0]), "b": int(b[0])}
        if key in JOINTS and issubclass(JOINTS[key], PointJoint):
            words["at"] = at[0]
    first = joint_of(world, kinds)
    columns = {name: value for name in Joint.columns if (value := vars(first).get(name)) is not None}
    columns |= {"a": a, "b": b}
    if columns["along"] != LINE:
        pose, rows_a, rows_b = world[Transform], world.slots.rows(a), world.slots.rows(b)
        back_a, back_b = (quaternion.conjugate(pose.rotation[rows]) for rows in (rows_a, rows_b))
        frame = quaternion.multiply(pose.rotation[rows_b], columns["frame_b"])
        columns["anchor_a"] = quaternion.rotate(back_a, at - pose.position[rows_a])
        columns["anchor_b"] = quaternion.rotate(back_b, at - pose.position[rows_b])
        columns["frame_a"] = quaternion.multiply(back_a, frame)
    return world.spawn_many(len(a), Joint(**columns), names=names)
