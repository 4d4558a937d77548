"""Bookkeeping: after each system of the step, what it did to the energy of bodies, into the ledger."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from carom.ecs import ExternalForce, Force, Schedule, System, Transform
from carom.ecs.column import Booleans, Floats
from carom.ecs.components.flight import Flight
from carom.ecs.relations.impact import Impact
from carom.systems.energy import kinetic_energy, potential_energies
from carom.systems.events import Events
from carom.systems.kernels.accounting import ARC, BENT, STRAYED, SWEPT, TURNED
from carom.systems.kernels.lanes import aligned
from carom.systems.ledger import KINDS, Dissipation, Ledger
from carom.systems.linkage import Linkage
from carom.systems.resting import Resting
from carom.systems.settings import Settings
from carom.systems.step import STEP
from carom.systems.work import Moving, Pull, Velocities, impulses_before

if TYPE_CHECKING:
    from carom.systems.simulation import Simulation


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
        ledger.parts, self._stood = [], total

    def _wake(self) -> None:
        """What events have done, right away and by commands."""
        if self._world[Events].due:
            self._book("events", self._total() - self._stood)

    def _begin_substep(self) -> None:
        world = self._world
        self._h = world[Settings].dt / world[Settings].substeps
        self._held, self._moving = potential_energies(world), kinetic_energy(world)
        self._pulls: list[Pull] = []

    def _predict(self) -> None:
        """Bodies are at the middle; what was set from outside along locked axes is gone."""
        self._moved, flight = Moving(self._world), self._world[Flight]
        rows = self._moved.rows
        self._from = flight.start_center[rows]
        self._start = Velocities(flight.start_linear[rows], flight.start_angular[rows])
        vectors, numbers = np.zeros((len(rows), 3)), np.zeros(len(rows))
        self._summed = self._nothing = [vectors, vectors, numbers, vectors, numbers]
        self._book("locks", self._moved.kinetic(self._start) - self._moving)

    def _note_pull(self, name: str) -> None:
        force = self._world[Force]
        summed = [getattr(force, column)[self._moved.rows] for column in Pull._fields[1:]]
        added = [now - before for now, before in zip(summed, self._summed, strict=True)]
        if any(column.any() for column in added):
            self._pulls.append(Pull(name, *added))
            self._summed = summed

    def _sum_forces(self) -> None:
        external, rows = self._world[ExternalForce], self._moved.rows
        pushes = external.force[rows], external.torque[rows]
        if any(push.any() for push in pushes):
            self._pulls.append(Pull("external", *pushes, *self._nothing[2:]))
        self._spun_by = self._world[Flight].angular_acceleration[rows]

    def _kick(self) -> None:
        """Drag comes first; then velocities are kicked, or arcs bent."""
        world, rows, h, ledger = self._world, self._moved.rows, self._h, self._ledger
        flight, scheme, moving = world[Flight], world[Settings].integrator, self._moved.now()
        self._kicked: Booleans = (flight.touching[rows] | (scheme == "semi_implicit"))[:, None]
        at_once = np.where(self._kicked, h, 0.0)
        self._dragged = Velocities(
            moving.linear - at_once * flight.felt[rows], moving.angular - at_once * self._spun_by
        )
        self._book_drag(self._start, self._dragged, np.where(self._kicked, h, 0.5 * h if scheme == "verlet" else 0.0))
        ledger.pull, ledger.arc = +flight.acceleration, np.zeros((len(flight.acceleration), ARC))
        self._arc_turns = flight.angular_acceleration[rows]
        self._earlier, self._impacts = impulses_before(world), world.count(Impact)
        self._earlier_joints = aligned(*world[Linkage].lanes.shape)

    def _hold(self) -> None:
        """Kick and contacts act together; what balls take out of it is spread along their arcs."""
        flight, rows = self._world[Flight], self._moved.rows
        self._mean = mean = self._dragged.mean(self._moved.now())
        self._book_held(mean)
        self._momentum = self._moved.angular_momentum(mean.angular)
        spread = flight.acceleration[rows] - self._ledger.pull[rows]
        self._spun = flight.angular_acceleration[rows] - self._arc_turns
        work = (self._moved.mass[:, None] * spread * mean.linear).sum() + (self._spun * self._momentum).sum()
        self._book("integration", -self._h * work)

    def _drift(self) -> None:
        world, rows, ledger = self._world, self._moved.rows, self._ledger
        flight, arc = world[Flight], ledger.arc[rows]
        way, swept = flight.center[rows] - self._from, np.where(self._kicked, self._h * self._momentum, arc[:, SWEPT:])
        for pull in self._pulls:
            self._book(pull.name, (pull.force * way).sum() + (self._moved.turning(pull.torque) * swept).sum())
        strayed = self._moved.mass[:, None] * flight.felt[rows] * (self._h * self._mean.linear - way)
        self._book("integration", (strayed * self._kicked).sum() + arc[:, STRAYED].sum())
        self._book("integration", arc[:, BENT].sum() + (self._spun * arc[:, SWEPT:]).sum())
        self._book("turning", arc[:, TURNED].sum())
        impact, new = world[Impact], slice(self._impacts, world.count(Impact))
        self._book_pairs(Dissipation.of(impact.a[new], impact.b[new], impacts=impact.work[new]))
        ledger.pull, ledger.arc = ledger.pull[:0], ledger.arc[:0]
        self._flown = self._moved.now()

    def _settle(self) -> None:
        """The rest of drag comes last, where bodies are now."""
        world = self._world
        late = {"verlet": 0.5, "euler": 1.0, "semi_implicit": 0.0}[world[Settings].integrator] * self._h
        self._moved.turn, settled = world[Transform].rotation, self._moved.now()
        self._book_drag(self._flown, settled, np.where(self._kicked, 0.0, late))
        held = potential_energies(world)
        for name, energy in held.items():
            self._book(name, energy - self._held[name])
        self._held, self._settled = held, settled
        lanes, joints = world[Resting].lanes, world[Linkage].lanes
        self._earlier, self._earlier_joints = aligned(*lanes.shape), aligned(*joints.shape)
        self._earlier[:], self._earlier_joints[:] = lanes, joints

    def _relax(self) -> None:
        self._book_held(self._settled.mean(self._moved.now()))
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

    def _book_drag(self, before: Velocities, after: Velocities, time: Floats) -> None:
        for name, energy in self._moved.by_drag(self._pulls, self._summed, before, after, time):
            self._book(name, energy)

    def _book_held(self, mean: Velocities) -> None:
        """Book what resting contacts and joints have done since the last time, while bodies went at ``mean``."""
        momenta = self._moved.momenta(mean)
        self._book_pairs(self._moved.by_contacts(self._earlier, momenta))
        for name, energy in self._moved.by_joints(self._earlier_joints, momenta):
            self._book(name, energy)

    def _book_pairs(self, part: Dissipation) -> None:
        """Book what pairs did, each kind of it under its own name."""
        self._ledger.parts.append(part)
        for name in KINDS:
            self._book(name, getattr(part, name).sum())


STAGES: dict[str, Callable[[Bookkeeping], None]] = {
    "begin_step": Bookkeeping._begin,
    "wake_disturbed": Bookkeeping._wake,
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
