"""Bookkeeping: after each system of the step, what it did to the energy of bodies, into the ledger.

An impulse J changes kinetic energy by J.(v + v')/2, and what acts together shares the mean of the velocities before and
after; so each entry is exact by itself. Torques go by angular momentum likewise.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from carom.ecs import ExternalForce, Force, Motion, RigidBody, Schedule, System, Transform
from carom.ecs.column import Booleans, Floats
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.systems.energy import dynamic_rows, kinetic_energy, potential_energies
from carom.systems.kernels.accounting import ARC, BENT, STRAYED, SWEPT, TURNED, find_work
from carom.systems.kernels.lanes import WIDTH, aligned
from carom.systems.kernels.packing import pack_velocities
from carom.systems.kernels.turning import find_angular_momentum, find_turning
from carom.systems.ledger import Dissipation, Ledger
from carom.systems.resting import Resting
from carom.systems.settings import Settings
from carom.systems.step import STEP

if TYPE_CHECKING:
    from carom.systems.simulation import Simulation


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


class Bookkeeping:
    """Books into the ledger of a simulation; `note` is to be told of every system that has run."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation, self._world = simulation, simulation.world
        self._ledger: Ledger = self._world[Ledger]
        self._energy: float | None = None
        self._schedule: Schedule | None = None
        self._ledger.kept = True

    def _follow(self, schedule: Schedule) -> None:
        """Know the systems of a schedule from now on."""
        own, systems = {system.name for _, system in STEP}, [system for _, system in schedule]
        self._strange = {system.name for system in systems if system.name not in own and Force not in system.adds}
        self._before_strange = {a.name for a, b in pairwise(systems) if b.name in self._strange}
        self._schedule, self._measured = schedule, 0.0

    def note(self, system: System) -> None:
        """Book what a system has done."""
        if self._schedule is not self._simulation.schedule:
            self._follow(self._simulation.schedule)
        name = system.name
        if stage := STAGES.get(name):
            stage(self)
        elif Force in system.adds:
            self._note_pull(name.removeprefix("apply_"))
        elif name in self._strange:
            self._book(name, self._total() - self._measured)
        if name in self._before_strange:
            self._measured = self._total()

    # The stages of a step, in their order ---------------------------------------------------------------
    def _begin(self) -> None:
        ledger, total = self._ledger, self._total()
        ledger.entries.clear()
        self._began = total if self._energy is None else self._energy
        self._book("edits", total - self._began)
        ledger.parts = []

    def _begin_substep(self) -> None:
        world = self._world
        self._h = world[Settings].dt / world[Settings].substeps
        self._held, self._moving = potential_energies(world), kinetic_energy(world)
        self._pulls: list[Pull] = []

    def _predict(self) -> None:
        """Bodies are at the middle; what was set from outside along locked axes is gone."""
        self._rows = rows = dynamic_rows(self._world)
        flight, transform = self._world[Flight], self._world[Transform]
        self._mass = self._world[RigidBody].mass[rows]
        self._from, self._turn, self._middle = flight.start_center[rows], flight.start_rotation, +transform.rotation
        self._start = Velocities(flight.start_linear[rows], flight.start_angular[rows])
        vectors, numbers = np.zeros((len(rows), 3)), np.zeros(len(rows))
        self._summed = self._nothing = [vectors, vectors, numbers, vectors, numbers]
        self._book("locks", self._kinetic(self._start) - self._moving)

    def _note_pull(self, name: str) -> None:
        force = self._world[Force]
        summed = [getattr(force, column)[self._rows] for column in Pull._fields[1:]]
        added = [now - before for now, before in zip(summed, self._summed, strict=True)]
        if any(column.any() for column in added):
            self._pulls.append(Pull(name, *added))
            self._summed = summed

    def _sum_forces(self) -> None:
        external, rows = self._world[ExternalForce], self._rows
        pushes = external.force[rows], external.torque[rows]
        if any(push.any() for push in pushes):
            self._pulls.append(Pull("external", *pushes, *self._nothing[2:]))
        self._spun_by = self._world[Flight].angular_acceleration[rows]

    def _kick(self) -> None:
        """Drag comes first; then velocities are kicked, or arcs bent."""
        world, rows, h, ledger = self._world, self._rows, self._h, self._ledger
        flight, scheme, moving = world[Flight], world[Settings].integrator, self._now()
        self._kicked: Booleans = (flight.touching[rows] | (scheme == "semi_implicit"))[:, None]
        at_once = np.where(self._kicked, h, 0.0)
        self._dragged = Velocities(
            moving.linear - at_once * flight.felt[rows], moving.angular - at_once * self._spun_by
        )
        self._book_drag(self._start, self._dragged, np.where(self._kicked, h, 0.5 * h if scheme == "verlet" else 0.0))
        ledger.pull, ledger.arc = +flight.acceleration, np.zeros((len(flight.acceleration), ARC))
        self._arc_turns = flight.angular_acceleration[rows]
        self._earlier, self._impacts = aligned(*world[Resting].lanes.shape), world.count(Impact)

    def _hold(self) -> None:
        """Kick and contacts act together; what balls take out of it is spread along their arcs."""
        flight, rows = self._world[Flight], self._rows
        self._mean = mean = self._dragged.mean(self._now())
        self._book_contacts(mean)
        self._momentum = self._angular_momentum(mean.angular)
        spread = flight.acceleration[rows] - self._ledger.pull[rows]
        self._spun = flight.angular_acceleration[rows] - self._arc_turns
        work = (self._mass[:, None] * spread * mean.linear).sum() + (self._spun * self._momentum).sum()
        self._book("contacts", -self._h * work)

    def _drift(self) -> None:
        world, rows, ledger = self._world, self._rows, self._ledger
        flight, arc = world[Flight], ledger.arc[rows]
        way, swept = flight.center[rows] - self._from, np.where(self._kicked, self._h * self._momentum, arc[:, SWEPT:])
        for pull in self._pulls:
            self._book(pull.name, (pull.force * way).sum() + (self._turning(pull.torque) * swept).sum())
        strayed = self._mass[:, None] * flight.felt[rows] * (self._h * self._mean.linear - way)
        self._book("integration", (strayed * self._kicked).sum() + arc[:, STRAYED].sum())
        self._book("contacts", arc[:, BENT].sum() + (self._spun * arc[:, SWEPT:]).sum())
        self._book("turning", arc[:, TURNED].sum())
        impact, new = world[Impact], slice(self._impacts, world.count(Impact))
        ledger.parts.append(Dissipation(+impact.a[new], +impact.b[new], +impact.work[new]))
        self._book("impacts", impact.work[new].sum())
        ledger.pull, ledger.arc = ledger.pull[:0], ledger.arc[:0]
        self._flown = self._now()

    def _settle(self) -> None:
        """The rest of drag comes last, where bodies are now."""
        world = self._world
        late = {"verlet": 0.5, "euler": 1.0, "semi_implicit": 0.0}[world[Settings].integrator] * self._h
        self._turn, settled = world[Transform].rotation, self._now()
        self._book_drag(self._flown, settled, np.where(self._kicked, 0.0, late))
        held = potential_energies(world)
        for name, energy in held.items():
            self._book(name, energy - self._held[name])
        self._held, self._settled = held, settled
        self._earlier = aligned(*world[Resting].lanes.shape)
        self._earlier[:] = world[Resting].lanes

    def _relax(self) -> None:
        self._book_contacts(self._settled.mean(self._now()))
        self._moving = kinetic_energy(self._world)

    def _hand_over(self) -> None:
        """Who commands have brought or taken since the last substep has brought or taken energy."""
        self._book("edits", self._total() - self._moving - sum(self._held.values()))
        self._moving = kinetic_energy(self._world)

    def _fall_asleep(self) -> None:
        self._book("sleep", kinetic_energy(self._world) - self._moving)

    def _end(self) -> None:
        total, ledger = self._total(), self._ledger
        ledger.change, self._energy = total - self._began, total
        ledger.since.update(ledger.entries)

    # What they share ---------------------------------------------------------------------------------------
    def _book(self, name: str, energy: float) -> None:
        self._ledger.entries[name] += float(energy)  # type: ignore[assignment]

    def _total(self) -> float:
        return kinetic_energy(self._world) + sum(potential_energies(self._world).values())

    def _now(self) -> Velocities:
        motion = self._world[Motion]
        return Velocities(motion.linear[self._rows], motion.angular[self._rows])

    def _kinetic(self, moving: Velocities) -> float:
        turning = (moving.angular * self._angular_momentum(moving.angular)).sum()
        return 0.5 * float((self._mass[:, None] * moving.linear * moving.linear).sum() + turning)

    def _angular_momentum(self, angular: Floats) -> Floats:
        body, momentum = self._world[RigidBody], np.empty_like(angular)
        find_angular_momentum(self._rows, angular, body.inertia, body.principal_axes, self._turn, momentum)
        return momentum

    def _turning(self, torque: Floats) -> Floats:
        """Return the angular acceleration (n, 3) by a torque, as at the middle of the substep."""
        body, turning = self._world[RigidBody], np.zeros_like(torque)
        if torque.any():
            find_turning(
                self._rows, torque, body.inverse_inertia, body.principal_axes, body.freedom, self._middle, turning
            )
        return turning

    def _book_drag(self, before: Velocities, after: Velocities, time: Floats) -> None:
        """Book drags that took ``time`` (n, 1); of several each has its share of the whole impulse."""
        mean = before.mean(after)
        drag = self._summed[2][:, None]
        if drag.any():
            rate = drag / self._mass[:, None]
            acting = np.where(drag > 0.0, drag, 1.0)
            flow = self._summed[3] / acting
            gone = np.where(drag > 0.0, -np.expm1(-rate * time) / np.where(drag > 0.0, rate, 1.0), 0.0)
            way = flow * time + (before.linear - flow) * gone  # along which it was dragged
            for pull in self._pulls:
                self._book(pull.name, ((pull.drag_flow * time - pull.drag[:, None] * way) * mean.linear).sum())
        spin_drag = self._summed[4]
        if spin_drag.any():
            lost = ((after.angular - before.angular) * self._angular_momentum(mean.angular)).sum(axis=1)
            for pull in self._pulls:
                self._book(pull.name, (lost * pull.angular_drag / np.where(spin_drag > 0.0, spin_drag, 1.0)).sum())

    def _book_contacts(self, mean: Velocities) -> None:
        """Book what resting contacts have done to bodies since the last time, that went at ``mean`` meanwhile."""
        resting, contact, motion = self._world[Resting], self._world[Contact], self._world[Motion]
        if not resting.groups:
            return
        momentum, spin = np.zeros_like(motion.linear), np.zeros_like(motion.angular)
        momentum[self._rows] = self._mass[:, None] * mean.linear
        spin[self._rows] = self._angular_momentum(mean.angular)
        momenta, work = aligned(*resting.bodies.shape), aligned(2 * resting.groups, WIDTH)
        pack_velocities(self._rows, momentum, spin, momenta)
        find_work(
            0, resting.groups, resting.index_a, resting.index_b, resting.points, resting.row, resting.asks,
            resting.lanes, resting.bodies, self._earlier, momenta, work,
        )  # fmt: skip
        first, along, across = resting.first[: resting.groups], work[::2], work[1::2]
        there = first >= 0
        self._book("contacts", along[there].sum())
        self._book("friction", across[there].sum())
        rows = first[there]
        self._ledger.parts.append(Dissipation(contact.a[rows], contact.b[rows], (along + across)[there]))


STAGES: dict[str, Callable[[Bookkeeping], None]] = {
    "begin_step": Bookkeeping._begin,
    "begin_substep": Bookkeeping._begin_substep,
    "predict": Bookkeeping._predict,
    "sum_forces": Bookkeeping._sum_forces,
    "kick": Bookkeeping._kick,
    "hold": Bookkeeping._hold,
    "drift": Bookkeeping._drift,
    "settle": Bookkeeping._settle,
    "relax": Bookkeeping._relax,
    "hand_impulses_over": Bookkeeping._hand_over,
    "fall_asleep": Bookkeeping._fall_asleep,
    "check_finite": Bookkeeping._end,
}
