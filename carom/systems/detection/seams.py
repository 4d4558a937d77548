"""Seams: contacts that boxes laid side by side hide from each other are left out."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.systems.detection.narrow import Found
from carom.systems.kernels.seams import hide_at_seams


def without_seams(world: World, found: Found) -> Found:
    """Return what is found without what `hide_at_seams` hides."""
    if not len(found.row_a):
        return found
    collider, pose = world[Collider], world[ColliderPose]
    hidden = np.empty(len(found.row_a), np.bool_)
    number = hide_at_seams(
        found.row_a, found.row_b, found.normal, found.depth, found.point,
        collider.shape, collider.size, collider.bound_half, collider.bound_radius,
        pose.position, pose.rotation, pose.body_row, hidden,
    )  # fmt: skip
    return found.without(hidden, number)
