"""Landings: who is on a joint meets others in the resting stage, together with its joints, and that is an impact too.

In flight it would be struck as if it were free, and its joints would have to make up for it afterwards.
"""

from __future__ import annotations

import numpy as np

from carom.ecs import Motion, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS, RUB, WARM
from carom.systems.progress import Progress
from carom.systems.resting import Resting


class Landings(Resource):
    """The manifolds that began to rest in this substep, of which one is on a joint, and how fast they closed."""

    def __init__(self) -> None:
        self._apart: Booleans = np.zeros(0, np.bool_)
        self._manifolds: Integers = np.zeros(0, np.int64)
        self._contacts: Integers = np.zeros(0, np.int64)
        self._speed: Floats = np.zeros(0)

    def expect(self, world: World) -> None:
        """Note which contacts do not rest yet and are of somebody on a joint."""
        contact, held = world[Contact], np.append(world[Flight].held, False)
        rows = slice(contact.count)
        self._apart = ~contact.resting[rows] & (held[contact.body_a[rows]] | held[contact.body_b[rows]])

    def find(self, world: World) -> None:
        """Find those of them that rest now, and the point of each manifold that closes fastest, and how fast."""
        contact, resting = world[Contact], world[Resting]
        rows = np.nonzero(self._apart & contact.resting[: contact.count])[0]
        closing = -_parting(world, rows)
        rows, closing = rows[closing > 0.0], closing[closing > 0.0]
        manifolds = np.searchsorted(resting.start[: resting.count + 1], rows, side="right") - 1
        order = np.lexsort((-closing, manifolds))
        self._manifolds, first = np.unique(manifolds[order], return_index=True)
        self._contacts, self._speed = rows[order[first]], closing[order[first]]

    def tell(self, world: World, h: float) -> None:
        """Append those that were pressed to the impacts, once; what they did to energy is told of contacts.

        After relaxing; or before contacts are found anew in the middle of the flight, since manifolds are others then:
        what the next substep finds to stop is not in the impulse.
        """
        resting, contact = world[Resting], world[Contact]
        if not len(self._manifolds):
            return
        manifolds, self._manifolds = self._manifolds, self._manifolds[:0]
        group, lane = resting.group_of[manifolds], resting.lane_of[manifolds]
        row, points = resting.row[group], np.diff(resting.start)[manifolds]
        impulse = np.zeros(len(row))
        for p in range(int(points.max())):
            there = points > p
            impulse[there] += resting.lanes[(row + MANIFOLD_ROWS + POINT_ROWS * p + WARM)[there], lane[there]]
        rubbed = np.stack([resting.lanes[row + RUB + k, lane] for k in range(3)], axis=1)
        pressed = impulse > 0.0
        rows, speed = self._contacts[pressed], self._speed[pressed]
        first = world.count(Impact)
        world.resize(Impact, first + len(rows))
        impact, new = world[Impact], slice(first, first + len(rows))
        wait = np.clip(-contact.depth[rows] / speed, 0.0, h)
        impact.time[new], impact.speed[new], impact.work[new] = world[Progress].clock + wait, speed, 0.0
        impact.a[new], impact.b[new] = contact.a[rows], contact.b[rows]
        impact.point[new], impact.normal[new] = contact.point[rows], contact.normal[rows]
        impact.impulse[new], impact.friction_impulse[new] = impulse[pressed], rubbed[pressed]
        order = np.argsort(impact.time[: impact.count], kind="stable")
        for name in Impact.columns:
            column = getattr(impact, name)
            column[: impact.count] = column[order]


def _parting(world: World, rows: Integers) -> Floats:
    """Return how fast the two bodies of each contact part along its normal (m/s)."""
    contact, motion = world[Contact], world[Motion]
    velocity = np.zeros((len(rows), 3))
    for bodies, offset, sign in ((contact.body_a, contact.offset_a, -1.0), (contact.body_b, contact.offset_b, 1.0)):
        body = bodies[rows]
        moves = motion.linear[body] + np.cross(motion.angular[body], offset[rows])
        velocity += sign * np.where((body >= 0)[:, None], moves, 0.0)
    return np.asarray((velocity * contact.normal[rows]).sum(axis=1))
