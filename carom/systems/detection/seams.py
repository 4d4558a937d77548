"""Seams: contacts that boxes laid side by side hide from each other are left out."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Booleans
from carom.ecs.component import Resource
from carom.systems.detection.narrow import Found
from carom.systems.kernels.seams import hide_at_seams, may_hide
from carom.systems.resting import Resting


class Seams(Resource):
    """Which colliders (rows) roll, glide and lie, and whether boxes may ``hide`` contacts; a cache, droppable."""

    def __init__(self) -> None:
        self.hide = False
        self.rolls: Booleans = np.zeros(0, np.bool_)
        self.glides = self.lies = self.rolls

    def now(self, world: World) -> Seams:
        """Return them, found anew where something was done from outside."""
        shape = world[Collider].shape
        if len(self.rolls) != len(shape) or not world[Resting].knows(world):
            self.rolls, self.glides, self.lies = np.zeros((3, len(shape)), np.bool_)
            self.hide = may_hide(
                world.row_numbers(Collider), shape, world[ColliderPose].body_row, self.rolls, self.glides, self.lies
            )
        return self


def without_seams(world: World, found: Found) -> Found:
    """Return what is found without what `hide_at_seams` hides."""
    seams = world[Seams].now(world)
    if not (seams.hide and len(found.row_a)):
        return found
    collider, pose = world[Collider], world[ColliderPose]
    hidden = np.empty(len(found.row_a), np.bool_)
    number = hide_at_seams(
        found.row_a, found.row_b, found.normal, found.depth, found.point, seams.rolls, seams.glides, seams.lies,
        collider.size, collider.bound_half, collider.bound_radius,
        pose.position, pose.rotation, pose.body_row, hidden,
    )  # fmt: skip
    return found.without(hidden, number)
