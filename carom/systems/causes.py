"""Causes: what changed the velocity of one body in a step, each force, contact, impact and joint by itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from carom.ecs import EntityError, ExternalForce, Force, Motion, RigidBody, System
from carom.ecs.column import Floats
from carom.ecs.components.flight import Flight
from carom.ecs.relations.impact import Impact
from carom.systems.compound import bodies_of
from carom.systems.kernels.lanes import aligned
from carom.systems.kernels.packing import pack_velocities
from carom.systems.linkage import Linkage
from carom.systems.observer import unobserved
from carom.systems.resting import Resting
from carom.systems.settings import Settings
from carom.systems.work import BY_JOINTS, Moving, impulses_before

if TYPE_CHECKING:
    from carom.systems.simulation import Simulation

NOBODY = -1
OUTSIDE = ("note_emitters", "wake_disturbed")  # who run right after what events and commands have done
UNITS = np.eye(3)


class Cause(NamedTuple):
    """What one source, with ``other`` (a handle, -1 for none) at its other end, did to a velocity (3,) in m/s."""

    source: str
    other: int
    change: Floats


class Causes(NamedTuple):
    """The velocity (3,) of a body before and after a step, m/s, and what changed it, the greatest first."""

    entity: int
    mass: float
    frame: int
    before: Floats
    after: Floats
    causes: list[Cause]

    @property
    def rest(self) -> Floats:
        """What no cause accounts for (3,), m/s: rounding."""
        return np.asarray(self.after - self.before - sum((cause.change for cause in self.causes), np.zeros(3)))


def take_step(simulation: Simulation, entity: int | str) -> Causes:
    """Take a step, unobserved, and return what changed the velocity of a body (handle or name) in it.

    Each cause is computed from its own force or impulse, none as the rest of the sum. Raises EntityError for who is not
    there or has no body.
    """
    world = simulation.world
    handle = world.find(entity) if isinstance(entity, str) else int(entity)
    row = int(bodies_of(world)[world.row(handle)])
    if row < 0:
        raise EntityError(f"'{world.name(handle)}' has no body; it stands")
    account = _Account(simulation, row)
    before = account.velocity()
    with unobserved(simulation):
        simulation.step(after=account.note)
    causes = [Cause(*key, change) for key, change in account.found.items() if change.any()]
    causes.sort(key=lambda cause: -float(np.linalg.norm(cause.change)))
    mass = float(world[RigidBody].mass[account.row])
    return Causes(world.entity(account.row), mass, world.frame, before, account.velocity(), causes)


class _Account:
    """Notes after each system what it did to the velocity of the body in ``row``."""

    def __init__(self, simulation: Simulation, row: int) -> None:
        self.row, self.found = row, dict[tuple[str, int], Floats]()
        self._world = simulation.world
        self._seen = self.velocity()
        self._drags: list[tuple[str, float, Floats]] = []
        self._stages: dict[str, Callable[[], None]] = {
            "predict": self._predict, "sum_forces": self._sum_forces, "kick": self._kick, "hold": self._hold,
            "drift": self._drift, "settle": self._settle, "relax": self._add_held,
        }  # fmt: skip

    def velocity(self) -> Floats:
        """Return the velocity (3,) as it is."""
        return np.array(self._world[Motion].linear[self.row])

    def note(self, system: System) -> None:
        """Note what a system has done."""
        if stage := self._stages.get(system.name):
            stage()
        elif Force in system.adds:
            self._note_force(system.name.removeprefix("apply_"))
        else:
            self._add("events" if system.name in OUTSIDE else system.name, self.velocity() - self._seen)
        self._seen = self.velocity()

    def _add(self, source: str, change: Floats, other: int = NOBODY) -> None:
        self.found[source, other] = self.found.get((source, other), np.zeros(3)) + change

    def _predict(self) -> None:
        """The body is at the middle of the substep; what was set along locked axes is gone."""
        world, row = self._world, self.row
        self._h = world[Settings].dt / world[Settings].substeps
        self._start = world[Flight].start_linear[row].copy()
        self._add("locks", self._start - self._seen)
        self._moving, self._drags, self._summed = Moving(world), [], np.zeros(7)

    def _note_force(self, name: str) -> None:
        force, row = self._world[Force], self.row
        summed = np.array([*force.force[row], *force.drag_flow[row], force.drag[row]])
        added, self._summed = summed - self._summed, summed
        self._add(name, self._h * self._felt(added[:3]))
        if added[3:].any():
            self._drags.append((name, float(added[6]), added[3:6]))

    def _felt(self, force: Floats) -> Floats:
        body = self._world[RigidBody]
        return np.asarray(force * body.inverse_mass[self.row] * body.freedom[self.row, :3])

    def _sum_forces(self) -> None:
        self._add("external", self._h * self._felt(self._world[ExternalForce].force[self.row]))

    def _kick(self) -> None:
        """Drag comes first, all of it or half; then the velocity is kicked, or the arc bent."""
        world, row, scheme = self._world, self.row, self._world[Settings].integrator
        flight = world[Flight]
        kicked = bool(flight.touching[row]) or scheme == "semi_implicit"
        before = 1.0 if kicked else 0.5 if scheme == "verlet" else 0.0
        dragged = self.velocity() - (self._h * flight.felt[row] if kicked else 0.0)
        self._add_drag(dragged - self._start, before * self._h)
        self._late = (1.0 - before) * self._h
        self._impacts = world.count(Impact)
        self._earlier, self._earlier_joints = impulses_before(world), aligned(*world[Linkage].lanes.shape)

    def _add_drag(self, change: Floats, time: float) -> None:
        """Share out what all drags did: each pulls by its flow, and by its part of the way that all have made of it."""
        whole = sum(drag for _, drag, _ in self._drags)
        if not (whole > 0.0 and time > 0.0):
            return
        flows = np.sum([flow for *_, flow in self._drags], axis=0)
        inverse_mass, free = self._world[RigidBody].inverse_mass[self.row], self._world[RigidBody].freedom[self.row, :3]
        way = free * flows * time - change / inverse_mass  # times the whole drag
        for name, drag, flow in self._drags:
            self._add(name, inverse_mass * (free * flow * time - drag / whole * way))

    def _hold(self) -> None:
        self._add_held()
        self._bent = np.array(self._world[Flight].acceleration[self.row])

    def _add_held(self) -> None:
        """Add what contacts and joints did since the last time: the work on a body of unit momentum is the change."""
        world, colliders = self._world, bodies_of(self._world)
        for axis, unit in enumerate(UNITS):
            momentum = np.zeros_like(world[Motion].linear)
            momentum[self.row, axis] = 1.0
            momenta = aligned(*world[Resting].bodies.shape[1:])
            pack_velocities(np.array([self.row]), momentum, np.zeros_like(momentum), momenta)
            part = self._moving.by_contacts(self._earlier, momenta)
            for a, b, along, across in zip(part.a.tolist(), part.b.tolist(), part.contacts, part.friction, strict=True):
                other = b if colliders[world.row(a)] == self.row else a
                self._add("contact", along * unit, other)
                self._add("friction", across * unit, other)
            rows, work = self._moving.of_joints(self._earlier_joints, momenta)
            for row, *done in zip(rows.tolist(), *work, strict=True):
                for name, change in zip(BY_JOINTS, done, strict=True):
                    self._add(name, change * unit, world.entity(row))

    def _drift(self) -> None:
        """Add impacts on the way; forces along arcs are known, but for what a pair that stays together keeps off.

        That goes the way of what its arc has lost, and is from the last that struck it, whenever it began.
        """
        world, impact, colliders = self._world, self._world[Impact], bodies_of(self._world)
        kept_off, together = self.velocity() - self._seen - self._h * self._bent, NOBODY
        for k in range(self._impacts, world.count(Impact)):
            a, b = int(impact.a[k]), int(impact.b[k])
            impulse = self._felt(impact.impulse[k] * impact.normal[k] + impact.friction_impulse[k])
            for own, other, sign in ((a, b, -1.0), (b, a, 1.0)):
                if colliders[world.row(own)] == self.row:
                    self._add("impact", sign * impulse, other)
                    kept_off -= sign * impulse
                    together = other
        lost = world[Flight].acceleration[self.row] - self._bent
        if lost.any() and together != NOBODY:
            self._add("contact", (kept_off @ lost) / (lost @ lost) * lost, together)
        self._flown = self.velocity()

    def _settle(self) -> None:
        """The rest of drag comes last."""
        world = self._world
        self._add_drag(self.velocity() - self._flown, self._late)
        lanes, joints = world[Resting].lanes, world[Linkage].lanes
        self._earlier, self._earlier_joints = aligned(*lanes.shape), aligned(*joints.shape)
        self._earlier[:], self._earlier_joints[:] = lanes, joints
