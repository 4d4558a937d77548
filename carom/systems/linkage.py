"""Linkage: the joints that hold bodies which are awake, in groups that are solved side by side."""

from __future__ import annotations

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.components.flight import Flight
from carom.ecs.components.joint import SLOTS, Joint
from carom.systems.awake import Awake
from carom.systems.constants import JOINT_HARDNESS, JOINT_RATE
from carom.systems.kernels.joint_groups import fill_joints, group_joints, hand_joints_over
from carom.systems.kernels.joint_impulses import finish_joints, solve_joints, start_joints_warm
from carom.systems.kernels.joint_places import measure_joints
from carom.systems.kernels.lanes import WIDTH, aligned
from carom.systems.kernels.packing import pack_poses


class Linkage(Resource):
    """Joints in groups, found anew when entities come or go, fall asleep or wake; a cache.

    ``rows`` are those of the joints, ``bodies`` those of the bodies they hold.
    """

    def __init__(self) -> None:
        self.groups = 0
        self.structure = -1
        self.rows: Integers = np.zeros(0, np.int64)
        self.bodies: Integers = np.zeros(0, np.int64)
        self.lanes = aligned(0, WIDTH)

    def find(self, world: World) -> None:
        """Group the joints that hold somebody who is awake, and write what they hold into the lanes."""
        joint, body = world[Joint], world[RigidBody]
        self.structure = world.structure
        rows = world.row_numbers(Joint)
        row_a, row_b = rows_of(world, joint.a), rows_of(world, joint.b)
        body_a, body_b = bodies_among(world, row_a[rows]), bodies_among(world, row_b[rows])
        asleep = world[Motion].asleep
        moves = ((body_a >= 0) & (body.inverse_mass[body_a] > 0.0) & ~asleep[body_a]) | (
            (body_b >= 0) & (body.inverse_mass[body_b] > 0.0) & ~asleep[body_b]
        )
        here = moves & held(joint.a, row_a, rows) & held(joint.b, row_b, rows)
        self.rows, body_a, body_b = rows[here], body_a[here], body_b[here]
        self.bodies = np.unique(np.concatenate([body_a, body_b]))
        self.bodies = self.bodies[self.bodies >= 0]
        count, nobody = len(self.rows), len(body.inverse_mass)
        self.kinds, self.row, self.asks = (
            np.empty(count, np.int64),
            np.empty(count, np.int64),
            np.empty(count, np.int64),
        )
        self.index_a, self.index_b = np.empty((count, WIDTH), np.int64), np.empty((count, WIDTH), np.int64)
        self.first, self.level_ends = np.empty((count, WIDTH), np.int64), np.empty(count, np.int64)
        self.groups, lanes, _ = group_joints(
            self.rows, body_a, body_b, body.inverse_mass, nobody,
            joint.along, joint.about, joint.mode, joint.lower, joint.driven, joint.friction,
            self.kinds, self.index_a, self.index_b, self.first, self.row, self.level_ends,
        )  # fmt: skip
        if len(self.lanes) < lanes:
            self.lanes = aligned(2 * lanes, WIDTH)
        transform = world[Transform]
        fill_joints(
            self.groups, self.kinds, self.index_a, self.index_b, self.first, self.row, nobody, body.center_of_mass,
            row_a, row_b, transform.position, transform.rotation,
            joint.anchor_a, joint.anchor_b, joint.frame_a, joint.frame_b,
            joint.mode, joint.lower, joint.upper, joint.restitution, joint.driven, joint.stiffness, joint.damping,
            joint.target, joint.speed, joint.most, joint.friction,
            joint.impulse, joint.drive_impulse, joint.friction_impulse, joint.position, self.asks, self.lanes,
        )  # fmt: skip

    def measure(self, world: World, bodies: Floats) -> None:
        """Find where joints are, of bodies that are packed."""
        flight = world[Flight]
        pack_poses(world[Awake].now(world), flight.center, world[Transform].rotation, bodies)
        measure_joints(self.groups, self.kinds, self.row, self.index_a, self.index_b, self.lanes, bodies)

    def start_warm(self, bodies: Floats) -> None:
        """Apply the impulses of the substep before."""
        start_joints_warm(self.groups, self.kinds, self.row, self.index_a, self.index_b, self.lanes, bodies)

    def solve(self, h: float, bodies: Floats, *, relaxing: bool) -> None:
        """Solve every joint once."""
        rate, hardness = (0.0, 1.0) if relaxing else (JOINT_RATE / h, JOINT_HARDNESS)
        solve_joints(
            relaxing, h, rate, hardness, self.groups, self.kinds, self.asks, self.row,
            self.index_a, self.index_b, self.lanes, bodies,
        )  # fmt: skip

    def finish(self, bodies: Floats) -> None:
        """Add the impulses of the substep to those of the step."""
        finish_joints(self.groups, self.kinds, self.row, self.index_a, self.index_b, self.lanes, bodies)

    def hand_over(self, world: World, dt: float) -> None:
        """Write what the step has found into the table of joints; forces are means over the step."""
        joint, rows = world[Joint], self.rows
        room = len(joint.a)
        held_back, driven, rubbed = np.zeros((room, SLOTS)), np.zeros((room, SLOTS)), np.zeros((room, SLOTS))
        force, torque = np.zeros((room, 3)), np.zeros((room, 3))
        hand_joints_over(
            self.groups, self.kinds, self.first, self.row, self.lanes,
            joint.impulse, joint.drive_impulse, joint.friction_impulse, joint.position, joint.velocity,
            held_back, driven, rubbed, force, torque,
        )  # fmt: skip
        joint.effort[rows], joint.force[rows], joint.torque[rows] = (
            driven[rows] / dt,
            force[rows] / dt,
            torque[rows] / dt,
        )


def rows_of(world: World, entities: Integers) -> Integers:
    """Return the rows (n,) of handles, -1 for the world and for who is gone."""
    rows: Integers = np.full(len(entities), -1)
    live = world.slots.live(entities)
    rows[live] = world.slots.rows(entities[live])
    return rows


def bodies_among(world: World, rows: Integers) -> Integers:
    """Return the rows that are of bodies, -1 in the place of others."""
    found: Integers = np.where((rows >= 0) & world.table(RigidBody).present[rows], rows, -1)
    return found


def held(entities: Integers, rows: Integers, joints: Integers) -> Booleans:
    """Tell of which joints one of the two, the world or an entity, is there."""
    there: Booleans = (entities[joints] < 0) | (rows[joints] >= 0)
    return there
