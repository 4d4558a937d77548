"""Sensing: the pairs of sensors, kept from the solver; who crosses their borders is found in every substep."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, Transform, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.spatial import quaternion
from carom.systems.detection.apart import NOBODY
from carom.systems.detection.broad import BroadPhase

NO_POSITIONS, NO_ROTATIONS = np.empty((0, 2, 3)), np.empty((0, 2, 4))


class Sensing(Resource):
    """Pairs of a sensor and who may meet it within the step, in order of handles; a cache of the step.

    ``pairs`` (n, 2) are handles. Poses (n, 2) are of both shapes in the frames of their bodies, of a static one in the
    world. ``gaps`` (n,) are those at the end of the last substep, or nearer to 0; None where pairs are new.
    """

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Begin a step."""
        self.pairs, self.positions, self.rotations = NOBODY, NO_POSITIONS, NO_ROTATIONS
        self.gaps: Floats | None = None

    def note(self, world: World, rows: Integers) -> None:
        """Add pairs of rows (n, 2), the sensor first, to those of the step."""
        pose, transform = world[ColliderPose], world[Transform]
        body = pose.body_row[rows]
        positions, rotations, moves = pose.position[rows], pose.rotation[rows], (body >= 0)[..., None]
        back = quaternion.conjugate(transform.rotation[body])
        in_body = quaternion.rotate(back, positions - transform.position[body])
        pairs = np.concatenate([self.pairs, world.entities(rows)])
        positions = np.concatenate([self.positions, np.where(moves, in_body, positions)])
        rotations = np.concatenate([self.rotations, np.where(moves, quaternion.multiply(back, rotations), rotations)])
        self.pairs, first = np.unique(pairs, axis=0, return_index=True)
        self.positions, self.rotations, self.gaps = positions[first], rotations[first], None

    def keep(self, which: Booleans) -> None:
        """Forget the other pairs."""
        self.pairs, self.positions, self.rotations = self.pairs[which], self.positions[which], self.rotations[which]
        self.gaps = None if self.gaps is None else self.gaps[which]


def without_sensors(world: World, pairs: Integers) -> Integers:
    """Return ``pairs`` (n, 2) of rows that the broad phase has found without those of sensors, which are noted."""
    if not world[BroadPhase].senses:
        return pairs
    senses = world[Collider].sensor[pairs]
    of_sensors = senses.any(axis=1)
    rows = pairs[of_sensors]
    world[Sensing].note(world, np.where(senses[of_sensors, :1], rows, rows[:, ::-1]))
    return pairs[~of_sensors]
