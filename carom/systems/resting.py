"""Resting: the manifolds of the contact table, and how contacts that rest yield."""

from __future__ import annotations

from math import pi

import numpy as np

from carom.ecs.component import Resource
from carom.ecs.relations.contact import Contact
from carom.systems.constants import CONTACT_DAMPING, CONTACT_FREQUENCY, RIGID_RATE
from carom.systems.kernels.manifolds import MANIFOLD_WIDTH, POINT_WIDTH, find_manifolds


class Resting(Resource):
    """Runs of contacts on one plane, and what the resting stage knows of them and their points in this substep."""

    def __init__(self) -> None:
        self.count = 0
        self.start = np.zeros(1, np.int64)
        self.known, self.known_point = np.zeros((0, MANIFOLD_WIDTH)), np.zeros((0, POINT_WIDTH))
        self.spread = np.zeros((0, 9))

    def group(self, contact: Contact) -> None:
        """Find the manifolds of the contact table, which detection has replaced."""
        points = contact.count
        self.start = np.empty(points + 1, np.int64)
        self.count = find_manifolds(points, contact.row_a, contact.row_b, contact.normal, self.start)
        self.known, self.known_point = np.zeros((self.count, MANIFOLD_WIDTH)), np.zeros((points, POINT_WIDTH))


def yielding(h: float) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Return how contacts of two moving bodies, and of one, yield in a substep of h seconds.

    Each is (rate at which overlap leaves, in 1/s, part of the mass, part of the impulse given up): Catto, Soft
    Constraints, GDC 2011. The frequency is limited by the substep's own.
    """
    circle = 2.0 * pi * min(CONTACT_FREQUENCY, 0.25 / h)
    one = 2.0 * CONTACT_DAMPING + h * circle
    two = h * circle * one
    return (circle / one, two / (1.0 + two), 1.0 / (1.0 + two)), (RIGID_RATE / h, 1.0, 0.0)
