"""Expectations that hold in every frame: conserved quantities, penetration, conditions."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from carom.ecs import World
from carom.ecs.column import Floats
from carom.ecs.relations.contact import Contact
from carom.systems.bodies import dynamic_rows
from carom.systems.energy import angular_momenta, kinetic_energy, momenta, potential_energy
from carom.systems.simulation import Simulation
from carom.worlds.condition import Condition
from carom.worlds.errors import WordError
from carom.worlds.expectation import Expectation
from carom.worlds.units import VALUE, read_quantity

LAW = re.compile(r"\s*(constant|non-increasing)\s*(?:within\s+(.+?))?\s*")
BOUND = re.compile(r"\s*(<=?)\s*(.+?)\s*")
ROUNDING = 1e-9  # of the largest energy seen: what an energy that does not increase may gain by rounding


@dataclass(frozen=True)
class Quantity:
    """A conserved quantity: ``measure`` returns its value and the size of what it is the sum of."""

    name: str
    unit: str
    measure: Callable[[World], tuple[Floats, float]]


def _energy(world: World) -> tuple[Floats, float]:
    kinetic, potential = kinetic_energy(world), potential_energy(world)
    return np.array([kinetic + potential]), max(abs(kinetic), abs(potential))


def _momentum(world: World) -> tuple[Floats, float]:
    each = momenta(world, dynamic_rows(world))
    return each.sum(axis=0), float(np.linalg.norm(each, axis=1).sum())


def _angular_momentum(world: World) -> tuple[Floats, float]:
    each = angular_momenta(world, dynamic_rows(world))
    return each.sum(axis=0), float(np.linalg.norm(each, axis=1).sum())


QUANTITIES = {
    "energy": Quantity("energy", "J", _energy),
    "momentum": Quantity("momentum", "kg m/s", _momentum),
    "angular_momentum": Quantity("angular momentum", "kg m2/s", _angular_momentum),
}


class Conserved(Expectation):
    """``constant within X`` or, for energy, ``non-increasing``; X is a share, or an amount with a unit."""

    def __init__(self, key: str, text: str) -> None:
        self.quantity = QUANTITIES[key]
        found = LAW.fullmatch(text)
        falls = found is not None and found[1] == "non-increasing"
        if found is None or (falls and key != "energy") or (found[2] is None and not falls):
            forms = "constant within X" + (" or non-increasing" if key == "energy" else "")
            raise WordError(f"is no law of {self.quantity.name}", received=repr(text), accepted=forms)
        self.falls = falls
        self.share, self.amount = _tolerance(found[2], self.quantity.unit)
        super().__init__(f"{key}: {text}", f"{self.quantity.name} {text.strip()}")
        self.largest = self.excess = 0.0

    def begin(self, simulation: Simulation) -> None:
        """Take the value to compare with."""
        self.reference, self.largest = self.quantity.measure(simulation.world)

    def observe(self, simulation: Simulation) -> None:
        """Compare with the first value, or with the lowest so far."""
        value, size = self.quantity.measure(simulation.world)
        self.largest = max(self.largest, size)
        change = float((value - self.reference)[0]) if self.falls else float(np.linalg.norm(value - self.reference))
        allowed = self.amount if self.share is None else self.share * self.largest
        received = f"{_text(value)} {self.quantity.unit}, {change:.3g} from {_text(self.reference)}"
        if not change <= allowed:
            self.fail(simulation, received)
        if not change <= self.excess or not self.worst:
            self.excess, self.worst = change, received
        if self.falls:
            self.reference = np.minimum(self.reference, value)


def _tolerance(text: str | None, unit: str) -> tuple[float | None, float]:
    """Return a share of the quantity, or None and an amount of it."""
    if text is None:
        return ROUNDING, 0.0
    found = VALUE.fullmatch(text)
    if found is not None and found[3] in ("", "%"):
        return read_quantity(text, "1", least=0.0), 0.0
    return None, read_quantity(text, unit, least=0.0)


def _text(value: Floats) -> str:
    return f"{value[0]:.9g}" if len(value) == 1 else "[" + ", ".join(f"{part:.9g}" for part in value) + "]"


class Penetration(Expectation):
    """``< 1 mm``: how deep colliders may overlap."""

    def __init__(self, text: str) -> None:
        found = BOUND.fullmatch(text)
        if found is None:
            raise WordError("is no bound", received=repr(text), accepted="'< 1 mm'")
        self.strict, self.bound = found[1] == "<", read_quantity(found[2], "m")
        super().__init__(f"penetration: {text}", f"overlap {text.strip()}")
        self.deepest = 0.0

    def observe(self, simulation: Simulation) -> None:
        """Look at the depth of every contact."""
        world = simulation.world
        contacts = world[Contact]
        if not contacts.count:
            return
        row = int(np.argmax(contacts.depth[: contacts.count]))
        depth = float(contacts.depth[row])
        names = [world.name(int(side[row])) for side in (contacts.a, contacts.b)]
        pair = " and ".join(names)
        if depth > self.deepest:
            self.deepest, self.worst = depth, f"{depth:.3g} m between {pair}"
        if not (depth < self.bound if self.strict else depth <= self.bound):
            self.fail(simulation, f"{depth:.3g} m between {pair}", names)


class Throughout(Expectation):
    """``always`` or ``never`` a condition, the start included."""

    def __init__(self, key: str, condition: Condition) -> None:
        self.wanted, self.condition, self.looks = key == "always", condition, condition.looks
        super().__init__(f"{key}: {condition.text}", f"{key} {condition.text}")
        self.least, self.asked = np.inf, False

    def begin(self, simulation: Simulation) -> None:
        """See the world before its first step."""
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Evaluate the condition for each entity it speaks of."""
        there, holds, margin = self.condition.evaluate(simulation.world)
        self.asked |= bool(there.any())
        room = np.where(there, margin if self.wanted else -margin, np.inf)
        index = int(np.argmin(room))
        if room[index] < self.least:
            self.least, self.worst = float(room[index]), self.condition.values(simulation.world, index)
        failing = np.nonzero(there & (holds != self.wanted))[0]
        if len(failing):
            index = int(failing[0])
            self.fail(simulation, self.condition.values(simulation.world, index), self.condition.of(index))

    def end(self, simulation: Simulation) -> None:
        """Fail where nobody came of whom it speaks."""
        if not self.asked:
            self.fail(simulation, f"never asked, since {self.condition.absence(simulation.world)}")
