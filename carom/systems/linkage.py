"""Linkage: the joints that hold bodies which are awake, in groups that are solved side by side."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.components.flight import Flight
from carom.ecs.components.joint import Joint
from carom.systems.awake import Awake
from carom.systems.constants import JOINT_HARDNESS, JOINT_RATE
from carom.systems.kernels.joint_filling import fill_joints
from carom.systems.kernels.joint_groups import group_joints
from carom.systems.kernels.joint_loads import hand_joints_over
from carom.systems.kernels.joint_marks import mark_held
from carom.systems.kernels.joint_places import measure_joints
from carom.systems.kernels.lanes import WIDTH, aligned
from carom.systems.settings import Settings
from carom.systems.ties import Ties

NOBODY: Integers = np.zeros(0, np.int64)


class Linkage(Resource):
    """Joints (``rows``) in groups, found anew when others are held, fall asleep or wake; a cache."""

    def __init__(self) -> None:
        self.groups = self.version = 0
        self.measured = self.weighed = False  # where bodies are packed now, and what they weigh
        self.holds = True  # bodies may be marked as held
        self.marked = False  # who is held, now and for as long as these joints are
        self.restored = -1
        self.awake = self.rows = self.joined = NOBODY
        self.lanes = aligned(0, WIDTH)
        self._reserve(0)

    def is_of(self, world: World) -> bool:
        """Tell whether the groups are of who is held and awake now."""
        rows, before = world[Awake].now(world), self.awake
        same = self.version == world[Ties].now(world).version and self.restored == world.restored
        if same and (rows is before or np.array_equal(rows, before)):
            self.awake = rows  # who is found anew after every change from outside, to be told at once from then on
            return True
        return False

    def find(self, world: World) -> None:
        """Group the joints that hold somebody who is awake, and write what they hold into the lanes."""
        joint, body, ties, transform = world[Joint], world[RigidBody], world[Ties].now(world), world[Transform]
        self.version, self.restored, self.awake = ties.version, world.restored, world[Awake].now(world)
        moves = np.zeros(len(body.inverse_mass) + 1, np.bool_)  # the last is nobody
        moves[self.awake] = body.inverse_mass[self.awake] > 0.0
        here = moves[ties.body_a] | moves[ties.body_b]
        self.rows, body_a, body_b = ties.rows[here], ties.body_a[here], ties.body_b[here]
        count, nobody = len(self.rows), len(body.inverse_mass)
        self.joined = np.zeros(nobody + 1, np.int64)  # 1 for who moves and is held, 0 for all others
        self.joined[body_a] = self.joined[body_b] = 1
        self.joined[~moves] = 0
        self._reserve(count)
        self.measured = self.weighed = self.marked = False
        self.groups, lanes = group_joints(
            self.rows, body_a, body_b, body.inverse_mass, nobody,
            joint.along, joint.about, joint.mode, joint.lower,
            joint.driven, joint.stiffness, joint.damping, joint.friction,
            self.kinds, self.asks, self.index_a, self.index_b, self.first, self.place, self.row,
        )  # fmt: skip
        if len(self.lanes) < lanes:
            self.lanes = aligned(2 * lanes, WIDTH)
        fill_joints(
            self.groups, self.kinds, self.asks, self.index_a, self.index_b, self.first, self.place, self.row, nobody,
            body.center_of_mass, ties.row_a[here], ties.row_b[here], transform.position, transform.rotation,
            joint.anchor_a, joint.anchor_b, joint.frame_a, joint.frame_b,
            joint.mode, joint.lower, joint.upper, joint.restitution, joint.stiffness, joint.damping,
            joint.target, joint.speed, joint.most, joint.friction,
            joint.impulse, joint.drive_impulse, joint.friction_impulse, joint.position, joint.velocity, self.lanes,
        )  # fmt: skip

    def mark(self, world: World, h: float) -> None:
        """Count bodies as touching and held by joints in the next h seconds; ropes that hang slack do not hold.

        Who is held goes on to be, and its arc begins as one who touches, until joints are found anew.
        """
        if self.marked:
            return
        flight, motion = world[Flight], world[Motion]
        self.marked = not mark_held(
            self.awake, self.groups, self.kinds, self.asks, h, self.row, self.index_a, self.index_b, self.first,
            self.lanes, flight.center, world[Transform].rotation, motion.linear, motion.angular, flight.felt,
            flight.touching, flight.held,
        )  # fmt: skip

    def _reserve(self, count: int) -> None:
        self.kinds, self.row, self.asks = (np.empty(count, np.int64) for _ in range(3))
        self.index_a, self.index_b, self.first, self.place = (np.empty((count, WIDTH), np.int64) for _ in range(4))

    def measure(self, world: World, bodies: Floats) -> None:
        """Find where joints are, of bodies that are packed, unless that is known."""
        if not self.measured:
            weigh = not self.weighed or world[Awake].strangers
            measure_joints(weigh, self.groups, self.kinds, self.row, self.index_a, self.index_b, self.lanes, bodies)
            self.measured = self.weighed = True

    def asked(self, h: float, relaxing: bool) -> tuple[Any, ...]:
        """Return what `take_turns` asks of joints: how they yield, and the groups.

        What they are off by leaves at a rate (1/s), with so much of the mass, unless it is ``relaxing``.
        """
        yielding = (0.0, 1.0) if relaxing else (JOINT_RATE / h, JOINT_HARDNESS)
        groups = self.groups, self.kinds, self.asks, self.row, self.index_a, self.index_b, self.lanes
        return *yielding, *groups

    def hand_over(self, world: World) -> None:
        """Write what was found since the last time into the table of joints."""
        joint = world[Joint]
        hand_joints_over(
            self.groups, self.kinds, self.first, self.row, world[Settings].dt, joint.mode, self.lanes,
            joint.impulse, joint.drive_impulse, joint.friction_impulse, joint.position, joint.velocity,
            joint.limit, joint.effort, joint.force, joint.torque,
        )  # fmt: skip
