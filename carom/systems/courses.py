"""Courses: the ways of the two shapes of pairs within a substep, and how near they are at any time of it."""

from __future__ import annotations

import numpy as np

from carom.ecs import Collider, ColliderPose, Motion, RigidBody, Transform, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.relations.impact import Impact
from carom.ecs.spatial import quaternion
from carom.systems.constants import SENSED
from carom.systems.detection.narrow import measure_pairs
from carom.systems.detection.sensors import Sensing
from carom.systems.progress import Progress
from carom.systems.settings import Settings
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.point import Point
from carom.systems.shapes.sphere import Sphere

BALLS = (Sphere.number, Point.number)
NOT_CONVEX = (Mesh.number, HeightField.number)


class Courses:
    """The ways within the substep that has just been flown, of pairs (n, 2): arrays are (n, 2, ...), by side.

    A centre of mass flies its arc, exact where nothing struck it. One that was struck flies the arc from the last
    impact on, and before it another to there, straight where it was struck more than once. Rotation is even throughout.
    """

    def __init__(self, world: World, sensing: Sensing, span: float) -> None:
        pose, flight, transform = world[ColliderPose], world[Flight], world[Transform]
        self.world, self.span = world, span
        self.rows: Integers = world.slots.rows(sensing.pairs.ravel()).reshape(-1, 2)
        self.local, self.turned = sensing.positions, sensing.rotations
        body = pose.body_row[self.rows]
        self.moves = (body >= 0)[..., None]
        self.lever = self.local - world[RigidBody].center_of_mass[body]
        self.first_turn, self.last_turn = flight.start_rotation[body], transform.rotation[body]
        offset = quaternion.rotate(self.first_turn, world[RigidBody].center_of_mass[body])
        self.begin, self.end = flight.start_position[body] + offset, flight.center[body]
        bend = 0.5 if world[Settings].integrator == "verlet" else 0.0
        self.arc = bend * flight.acceleration[body]
        knots, strikes = self._struck(body)
        left = span - knots
        self.knot: Floats = knots
        self.middle = self.end - world[Motion].linear[body] * left + self.arc * left * left
        self.middle = np.where(knots > 0.0, self.middle, self.begin)
        self.first_arc = np.where(strikes > 1, 0.0, self.arc)
        self._bound(world[Collider])
        self.reach = self.speed * span + SENSED

    def _struck(self, body: Integers) -> tuple[Floats, Integers]:
        """Return when each body was struck last in the substep (s, 0 for never) and how often, each (n, 2, 1)."""
        world, impact = self.world, self.world[Impact]
        last, times = np.zeros(world.capacity), np.zeros(world.capacity, np.int64)
        time = impact.time[: impact.count] - world[Progress].clock
        now = (time > 0.0) & (time < self.span)
        for party in (impact.a[: impact.count], impact.b[: impact.count]):
            which = now & world.slots.live(party)
            struck = world[ColliderPose].body_row[world.slots.rows(party[which])]
            np.maximum.at(last, struck, time[which])
            np.add.at(times, struck, 1)
        return np.where(self.moves, last[body][..., None], 0.0), times[body][..., None]

    def _bound(self, collider: Collider) -> None:
        """Bound how fast gaps change (m/s), and how fast that changes (m/s2)."""
        rows, span, moves = self.rows, self.span, self.moves[..., 0]
        radius = length(collider.bound_center[rows] - collider.position[rows])
        radius += length(collider.bound_half[rows]) + collider.bound_radius[rows]
        radius[np.isin(collider.shape[rows], BALLS)] = 0.0
        lever = np.where(moves, length(self.lever) + radius, 0.0)
        turned, again = length(self.first_turn - self.last_turn), length(self.first_turn + self.last_turn)
        turning = np.where(moves, np.pi * np.minimum(turned, again) / span, 0.0)  # twice the sine of a quarter at most
        early = length(self.middle - self.begin) / np.where(self.knot > 0.0, self.knot, span)[..., 0]
        late = length(self.end - self.middle) / (span - self.knot)[..., 0]
        bent = np.where(moves, 2.0 * length(self.arc), 0.0)
        quick = np.where(moves, np.maximum(early, late), 0.0) + bent * span
        self.speed: Floats = (quick + turning * lever).sum(axis=1)
        self.bend: Floats = (bent + turning * turning * lever).sum(axis=1)
        self.bend[np.isin(collider.shape[rows], NOT_CONVEX).any(axis=1)] = np.inf

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
        at = np.repeat(times, 2)
        _, first, again = np.unique(self.rows[which], return_index=True, return_inverse=True)
        agreed = (at == at[first][again.ravel()]).reshape(-1, 2) | ~self.moves[which][..., 0]
        return np.asarray(agreed.all(axis=1))

    def _measured(self, which: Integers, times: Floats) -> Floats:
        world, pose, rows = self.world, self.world[ColliderPose], self.rows[which]
        before = pose.position[rows], pose.rotation[rows]
        pose.position[rows], pose.rotation[rows] = self._poses(which, times[:, None, None])
        found = measure_pairs(world, rows, self.reach[which])
        pose.position[rows], pose.rotation[rows] = before
        key = rows[:, 0] * world.capacity + rows[:, 1]
        order = np.argsort(key)
        pair = order[np.searchsorted(key, found.row_a * world.capacity + found.row_b, sorter=order)]
        gaps = self.reach[which]
        np.minimum.at(gaps, pair, -found.depth)
        return gaps

    def _poses(self, which: Integers, time: Floats) -> tuple[Floats, Floats]:
        """Return positions (k, 2, 3) and rotations (k, 2, 4) of both shapes of pairs at times (k, 1, 1)."""
        knot, begin, middle, end = self.knot[which], self.begin[which], self.middle[which], self.end[which]
        early, late, left = np.minimum(time, knot), np.maximum(time - knot, 0.0), self.span - knot
        center = begin + (middle - begin) * (early / np.where(knot > 0.0, knot, 1.0))
        center -= self.first_arc[which] * early * (knot - early)
        center += (end - middle) * (late / left) - self.arc[which] * late * (left - late)
        turn = quaternion.slerp(self.first_turn[which], self.last_turn[which], time[..., 0] / self.span)
        position = center + quaternion.rotate(turn, self.lever[which])
        rotation = quaternion.multiply(turn, self.turned[which])
        moves = self.moves[which]
        return np.where(moves, position, self.local[which]), np.where(moves, rotation, self.turned[which])


def length(vectors: Floats) -> Floats:
    """Return the lengths (...) of vectors (..., n)."""
    return np.asarray(np.sqrt((vectors * vectors).sum(axis=-1)))
