"""Grouping: the manifolds of the contact table go into groups that are solved side by side."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, RigidBody, World
from carom.ecs.relations.contact import Contact
from carom.systems.kernels.ball_seams import link_boxes
from carom.systems.kernels.filling import fill_groups
from carom.systems.kernels.groups import group_manifolds
from carom.systems.kernels.lane_widths import BLOCK, PLANES
from carom.systems.kernels.lanes import WIDTH, aligned
from carom.systems.kernels.manifolds import find_manifolds, part_masses
from carom.systems.kernels.refilling import refill_groups
from carom.systems.kernels.rubbing import IDLE
from carom.systems.resting import Resting
from carom.systems.threads import crew_for


def group_contacts(world: World, *, places: bool, same: bool) -> None:
    """Find the manifolds of the contact table, which detection has replaced, and put them into groups.

    They stay in theirs where the table is the ``same`` but for where contacts are, and all but a few rest as they did.
    Where contacts have the ``places`` in it that they had, they come into the groups in which they would have stayed.
    """
    resting, contact, body, collider = world[Resting], world[Contact], world[RigidBody], world[Collider]
    points, nobody = contact.count, len(body.inverse_mass)
    if len(resting.start) <= points:
        resting.start, resting.beside = np.empty(2 * points + 1, np.int64), np.empty(2 * points, np.int64)
    if resting.bodies.shape[1] != nobody + 1:
        resting.bodies, resting.packed = aligned(PLANES, nobody + 1, BLOCK), None
        resting.leans, resting.stirred = np.zeros((2, nobody + 1), np.bool_), np.empty((2, nobody + 1), np.int64)
    if not points:
        if resting.count:
            resting.bound_of = None
        resting.count = resting.groups = resting.levels = 0
        resting.solids = False
        return
    resting.count, resting.solids, resting.balls, boxes, several, stay, few = find_manifolds(
        points, contact.row_a, contact.row_b, contact.body_a, contact.body_b, contact.kind, contact.normal,
        contact.resting, contact.grouped, resting.start,
    )  # fmt: skip
    if boxes:
        link_boxes(points, contact.kind, contact.ball, nobody, resting.beside)
    if not (places and few):
        contact.grouped[:points] = contact.resting[:points]
    if same and stay and few:
        refill_groups(
            crew_for(world, resting.count), resting.groups, resting.first, resting.size, resting.row, resting.points,
            resting.even, contact.normal, contact.depth, contact.offset_a, contact.offset_b, contact.share,
            contact.resting, contact.row_a, contact.row_b, contact.body_a, contact.body_b,
            world[ColliderPose].rotation, collider.shape, collider.size, collider.bound_radius, resting.lanes,
        )  # fmt: skip
    else:
        _group_anew(world)
    now = slice(resting.groups)
    resting.asks[now], resting.fresh[now], resting.stale[now] = IDLE, True, False
    if several:
        part_masses(
            resting.count, resting.start, contact.row_a, contact.row_b, contact.body_a, contact.body_b, contact.normal,
            body.inverse_mass, resting.group_of, resting.lane_of, resting.row, resting.lanes,
        )  # fmt: skip


def _group_anew(world: World) -> None:
    resting, contact, body = world[Resting], world[Contact], world[RigidBody]
    resting.bound_of = None
    if len(resting.group_of) < resting.count:
        resting.reserve(2 * resting.count)
    resting.groups, rows, resting.levels = group_manifolds(
        resting.count, resting.start, contact.a, contact.b, contact.body_a, contact.body_b,
        contact.kind, contact.rolling, contact.spinning, contact.surface, contact.grouped,
        body.inverse_mass, body.inverse_inertia, body.freedom, len(body.inverse_mass),
        resting.group_of, resting.lane_of, resting.index_a, resting.index_b, resting.first, resting.size,
        resting.points, resting.row, resting.even, resting.ends, resting.run_ends,
    )  # fmt: skip
    if len(resting.lanes) < rows:
        resting.lanes = aligned(2 * rows, WIDTH)
    fill_groups(
        crew_for(world, resting.count), resting.groups, resting.first, resting.size, resting.row, resting.points,
        resting.even, contact.normal, contact.depth, contact.offset_a, contact.offset_b, contact.share,
        contact.kind, contact.sign, contact.radius, contact.extent,
        contact.friction, contact.restitution, contact.rolling, contact.spinning, contact.surface, contact.resting,
        contact.warm_normal, contact.warm_friction, contact.warm_rolling,
        contact.row_a, contact.row_b, contact.body_a, contact.body_b, world[ColliderPose].rotation,
        world[Collider].shape, world[Collider].size, world[Collider].bound_radius, resting.lanes,
    )  # fmt: skip
