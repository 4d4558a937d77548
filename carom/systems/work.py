"""Work: what turns, drags and contacts do to the bodies that move in a substep, each from its own impulse.

An impulse J changes kinetic energy by J.(v + v')/2, and what acts together shares the mean of the velocities before and
after; so each is exact by itself. Torques go by angular momentum likewise.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems.bodies import dynamic_rows
from carom.systems.kernels.accounting import count_from, find_work
from carom.systems.kernels.joint_accounting import DROVE, ENTRIES, HELD, RUBBED, find_joint_work
from carom.systems.kernels.lanes import WIDTH, aligned
from carom.systems.kernels.packing import pack_velocities
from carom.systems.kernels.turning import find_angular_momentum, find_turning
from carom.systems.ledger import Dissipation
from carom.systems.linkage import Linkage
from carom.systems.resting import Resting

BY_JOINTS = ("joints", "drives", "joint friction")


def impulses_before(world: World) -> Floats:
    """Return what impulses of contacts are counted from, once they are sorted, in a substep that begins."""
    resting = world[Resting]
    earlier = aligned(*resting.lanes.shape)
    count_from(resting.groups, resting.points, resting.row, resting.asks, resting.lanes, earlier)
    return earlier


class Velocities(NamedTuple):
    """Velocities and angular velocities (n, 3) of the dynamic bodies."""

    linear: Floats
    angular: Floats

    def mean(self, other: Velocities) -> Velocities:
        """Return the mean with others."""
        return Velocities(0.5 * (self.linear + other.linear), 0.5 * (self.angular + other.angular))


class Pull(NamedTuple):
    """What one system adds to the forces on the dynamic bodies, columns as those of `Force`."""

    name: str
    force: Floats
    torque: Floats
    drag: Floats
    drag_flow: Floats
    angular_drag: Floats


class Moving:
    """The dynamic bodies of a substep, n of them: ``rows``, ``mass`` in kg, and ``turn``, how all rows are turned.

    It is made at the middle of the substep and begins with the rotations at its start.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        self.rows = dynamic_rows(world)
        self.mass = world[RigidBody].mass[self.rows]
        self.turn, self._middle = world[Flight].start_rotation, +world[Transform].rotation

    def now(self) -> Velocities:
        """Return the velocities as they are."""
        motion = self._world[Motion]
        return Velocities(motion.linear[self.rows], motion.angular[self.rows])

    def kinetic(self, moving: Velocities) -> float:
        """Return the kinetic energy (J) of all at these velocities."""
        turning = (moving.angular * self.angular_momentum(moving.angular)).sum()
        return 0.5 * float((self.mass[:, None] * moving.linear * moving.linear).sum() + turning)

    def angular_momentum(self, angular: Floats) -> Floats:
        """Return the angular momentum (n, 3) in kg m2/s at angular velocities (n, 3)."""
        body, momentum = self._world[RigidBody], np.empty_like(angular)
        find_angular_momentum(self.rows, angular, body.inertia, body.principal_axes, self.turn, momentum)
        return momentum

    def turning(self, torque: Floats) -> Floats:
        """Return the angular acceleration (n, 3) by torques (n, 3), as at the middle of the substep."""
        body, turning = self._world[RigidBody], np.zeros_like(torque)
        if torque.any():
            find_turning(
                self.rows, torque, body.inverse_inertia, body.principal_axes, body.freedom, self._middle, turning
            )
        return turning

    def by_drag(
        self, pulls: Sequence[Pull], summed: Sequence[Floats], before: Velocities, after: Velocities, time: Floats
    ) -> Iterator[tuple[str, float]]:
        """Return the work (J) of drags that took ``time`` (n, 1), by name; of several each has its share of the whole.

        ``summed`` are the columns of `Force` that all of them make together.
        """
        mean = before.mean(after)
        drag = summed[2][:, None]
        if drag.any():
            rate = drag / self.mass[:, None]
            acting = np.where(drag > 0.0, drag, 1.0)
            flow = summed[3] / acting
            gone = np.where(drag > 0.0, -np.expm1(-rate * time) / np.where(drag > 0.0, rate, 1.0), 0.0)
            way = flow * time + (before.linear - flow) * gone  # along which it was dragged
            for pull in pulls:
                yield pull.name, float(((pull.drag_flow * time - pull.drag[:, None] * way) * mean.linear).sum())
        spin_drag = summed[4]
        if spin_drag.any():
            lost = ((after.angular - before.angular) * self.angular_momentum(mean.angular)).sum(axis=1)
            for pull in pulls:
                yield pull.name, float((lost * pull.angular_drag / np.where(spin_drag > 0.0, spin_drag, 1.0)).sum())

    def momenta(self, mean: Velocities) -> Floats:
        """Return the momenta of bodies that go at ``mean``, packed for the kernels that find work."""
        motion = self._world[Motion]
        momentum, spin = np.zeros_like(motion.linear), np.zeros_like(motion.angular)
        momentum[self.rows] = self.mass[:, None] * mean.linear
        spin[self.rows] = self.angular_momentum(mean.angular)
        momenta = aligned(*self._world[Resting].bodies.shape[1:])
        pack_velocities(self.rows, momentum, spin, momenta)
        return momenta

    def by_joints(self, earlier: Floats, momenta: Floats) -> Iterator[tuple[str, float]]:
        """Yield what joints did since their impulses were ``earlier``, by what they did it."""
        _, work = self.of_joints(earlier, momenta)
        yield from zip(BY_JOINTS, work.sum(axis=1).tolist(), strict=True)

    def of_joints(self, earlier: Floats, momenta: Floats) -> tuple[Integers, Floats]:
        """Return the rows of joints (n,), and what each did (3, n) since then, by what it did it."""
        linkage = self._world[Linkage]
        if not linkage.groups:
            return np.zeros(0, np.int64), np.zeros((ENTRIES, 0))
        work = aligned(ENTRIES * linkage.groups, WIDTH)
        find_joint_work(
            linkage.groups, linkage.kinds, linkage.row, linkage.index_a, linkage.index_b,
            linkage.lanes, self._world[Resting].bodies, earlier, momenta, work,
        )  # fmt: skip
        first = linkage.first[: linkage.groups]
        there = first >= 0
        return first[there], np.stack([work[entry::ENTRIES][there] for entry in (HELD, DROVE, RUBBED)])

    def by_contacts(self, earlier: Floats, momenta: Floats) -> Dissipation:
        """Return what resting contacts did since their impulses were ``earlier``."""
        resting, contact = self._world[Resting], self._world[Contact]
        if not resting.groups:
            return Dissipation.of()
        work = aligned(2 * resting.groups, WIDTH)
        find_work(
            0, resting.groups, resting.index_a, resting.index_b, resting.points, resting.row, resting.asks,
            resting.lanes, resting.bodies, earlier, momenta, work,
        )  # fmt: skip
        first, along, across = resting.first[: resting.groups], work[::2], work[1::2]
        there = first >= 0
        rows = first[there]
        return Dissipation.of(contact.a[rows], contact.b[rows], contacts=along[there], friction=across[there])
