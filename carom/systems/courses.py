"""Courses: how near the two shapes of pairs are at any time of a substep."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, Motion, RigidBody, Transform, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.relations.impact import Impact
from carom.systems.constants import SENSED
from carom.systems.detection.narrow import measure_pairs
from carom.systems.detection.sensors import Sensing
from carom.systems.kernels.courses import chart_courses, place_on_courses
from carom.systems.progress import Progress
from carom.systems.settings import Settings


class Courses:
    """The ways within the substep that has just been flown, of pairs (n, 2): arrays are (n, 2, ...), by side.

    A centre of mass flies its arc, exact where nothing struck it. One that was struck flies the arc from the last
    impact on, and before it another to there, straight where it was struck more than once. Rotation is even throughout.
    Gaps change by at most ``speed`` (n,), m/s, and are measured as far as that takes them until the end of the step.
    """

    def __init__(self, world: World, sensing: Sensing, span: float) -> None:
        self.world, self.sensing, self.span = world, sensing, span
        n, collider, flight = len(sensing.pairs), world[Collider], world[Flight]
        self.rows: Integers = world.slots.rows(sensing.pairs.ravel()).reshape(-1, 2)
        self.begin, self.middle, self.end = np.empty((n, 2, 3)), np.empty((n, 2, 3)), np.empty((n, 2, 3))
        self.early, self.late, self.knot = np.empty((n, 2, 3)), np.empty((n, 2, 3)), np.empty((n, 2))
        self.speed, self.bend = np.empty(n), np.empty(n)
        struck, strikes = self._struck()
        chart_courses(
            self.rows, sensing.positions, span, 0.5 if world[Settings].integrator == "verlet" else 0.0,
            world[ColliderPose].body_row, world[RigidBody].center_of_mass, flight.start_position,
            flight.start_rotation, flight.center, world[Transform].rotation, world[Motion].linear, flight.acceleration,
            struck, strikes, collider.shape, collider.position, collider.bound_center, collider.bound_half,
            collider.bound_radius,
            self.begin, self.middle, self.end, self.early, self.late, self.knot, self.speed, self.bend,
        )  # fmt: skip
        self.reach = self.speed * (span + world[Progress].left) + SENSED

    def _struck(self) -> tuple[Floats, Integers]:
        """Return by row of a body when it was struck last in the substep (s, 0 for never) and how often."""
        world, impact = self.world, self.world[Impact]
        last, strikes = np.zeros(world.capacity), np.zeros(world.capacity, np.int64)
        if impact.count:
            time = impact.time[: impact.count] - world[Progress].clock
            now = (time > 0.0) & (time < self.span)
            for party in (impact.a[: impact.count], impact.b[: impact.count]):
                which = np.nonzero(now & world.slots.live(party))[0]
                body = world[ColliderPose].body_row[world.slots.rows(party[which])]
                np.maximum.at(last, body[body >= 0], time[which[body >= 0]])
                np.add.at(strikes, body[body >= 0], 1)
        return last, strikes

    def gaps(self, which: Integers, times: Floats) -> Floats:
        """Return the gaps (k,), m, negative inside, at most the reach, of pairs ``which`` (k,) at ``times`` (k,), s."""
        found = np.empty(len(which))
        left = np.arange(len(which))
        while len(left):
            ready = self._agreed(which[left], times[left])
            found[left[ready]] = self._measured(which[left[ready]], times[left[ready]])
            left = left[~ready]
        return found

    def _agreed(self, which: Integers, times: Floats) -> Booleans:
        """Return who can be measured together: those whose shapes nobody before them wants at another time."""
        rows, at = self.rows[which], np.repeat(times, 2)
        _, first, again = np.unique(rows, return_index=True, return_inverse=True)
        agreed = (at == at[first][again.ravel()]).reshape(-1, 2) | (self.world[ColliderPose].body_row[rows] < 0)
        return np.asarray(agreed.all(axis=1))

    def _measured(self, which: Integers, times: Floats) -> Floats:
        world, pose, body, rows = self.world, self.world[ColliderPose], self.world[RigidBody], self.rows[which]
        before = pose.position[rows], pose.rotation[rows]
        place_on_courses(
            which, times, self.rows, self.sensing.positions, self.sensing.rotations, self.span, pose.body_row,
            body.center_of_mass, world[Flight].start_rotation, world[Transform].rotation,
            self.begin, self.middle, self.end, self.early, self.late, self.knot, pose.position, pose.rotation,
        )  # fmt: skip
        found = measure_pairs(world, rows, self.reach[which])
        pose.position[rows], pose.rotation[rows] = before
        keys = rows[:, 0] * world.capacity + rows[:, 1]
        order = np.argsort(keys)
        pair = order[np.searchsorted(keys, found.row_a * world.capacity + found.row_b, sorter=order)]
        gaps = self.reach[which]
        np.minimum.at(gaps, pair, -found.depth)
        return gaps
