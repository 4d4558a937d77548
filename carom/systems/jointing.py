"""Jointing: the systems of joints beside the solver, which finds their impulses."""

from __future__ import annotations

import numpy as np

from carom.ecs import Motion, Parent, RigidBody, Transform, World, system
from carom.ecs.column import Booleans
from carom.ecs.commands import Commands
from carom.ecs.components.flight import Flight
from carom.ecs.components.joint import Joint
from carom.ecs.relations.joint_break import JointBreak
from carom.systems.awake import Awake, stirs
from carom.systems.kernels.joint_loads import clear_loads, judge_joints
from carom.systems.linkage import Linkage
from carom.systems.progress import Progress
from carom.systems.settings import Settings
from carom.systems.ties import Ties


@system(reads=(RigidBody, Transform, Motion, Parent, Settings, Progress), writes=(Joint, Flight, Awake, Ties, Linkage))
def join_bodies(world: World, dt: float) -> None:
    """Find the joints of bodies that are awake; who is held is stepped semi-implicitly, as in contact."""
    linkage, begins = world[Linkage], world[Progress].substep == 1
    if not (linkage.groups or len(world[Ties].now(world).rows)):  # most worlds, in every substep
        if linkage.holds:
            rows, flight = world[Awake].now(world), world[Flight]
            flight.held[rows] = flight.touching[rows] = linkage.holds = False
        return
    if not linkage.is_of(world) or (begins and world[Awake].edited & {Joint, RigidBody, Transform}):
        if not begins:  # at the end of a step it has been done
            linkage.hand_over(world)
        linkage.find(world)
    if linkage.groups and begins:  # those that sleep go on bearing what they bore
        joint = world[Joint]
        clear_loads(linkage.rows, joint.effort, joint.force, joint.torque, joint.limit)
    if linkage.groups or linkage.holds:
        linkage.mark(world, dt)
        linkage.holds = linkage.groups > 0


@system(reads=(RigidBody, Awake, Settings), writes=(Joint, JointBreak, Linkage, Commands), when=stirs)
def tell_joints(world: World, dt: float) -> None:
    """Write how joints are loaded and where they are into their table; let those break that bear no more."""
    linkage, joint = world[Linkage], world[Joint]
    if not linkage.groups:
        return
    linkage.hand_over(world)
    breaks: Booleans = np.empty(len(linkage.rows), np.bool_)
    if judge_joints(
        linkage.rows, joint.mode, joint.lower, joint.upper, joint.position, joint.force, joint.torque,
        joint.break_force, joint.break_torque, joint.gap, joint.twist, joint.margin, breaks,
    ):  # fmt: skip
        rows = linkage.rows[breaks]
        world.resize(JointBreak, len(rows))
        broken, entities = world[JointBreak], world.entities(rows)
        broken.time[: len(rows)], broken.joint[: len(rows)] = world.frame * dt, entities
        broken.a[: len(rows)], broken.b[: len(rows)] = joint.a[rows], joint.b[rows]
        broken.force[: len(rows)] = np.sqrt((joint.force[rows] ** 2).sum(axis=1))
        broken.torque[: len(rows)] = np.sqrt((joint.torque[rows] ** 2).sum(axis=1))
        world[Commands].detach(entities, Joint)
