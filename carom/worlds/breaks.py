"""Breaks: the words for what a simulation stops at, ``speed(crate) > 20``, ``overlap > 1 cm``. No code is run."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np

from carom.ecs import World
from carom.ecs.errors import CaromError
from carom.ecs.relations.contact import Contact
from carom.systems.breakpoints import Breakpoint, Met
from carom.systems.energy import kinetic_and_potential
from carom.systems.simulation import Simulation
from carom.systems.tracing import refuse_contacts
from carom.worlds.condition import Condition, read_condition
from carom.worlds.errors import WordError
from carom.worlds.units import VALUE, read_quantity

NOT_FINITE = "not finite"
RISES = re.compile(r"energy\s+rises\s+(?:by\s+)?(.+)")
OVERLAP = re.compile(r"overlap\s*>\s*(.+)")
FRAME = re.compile(r"frame\s+(\d{1,18})")


@dataclass
class NotFinite:
    """A pose or velocity, at which every step stops, or a contact that is no number; told as NonFiniteError."""

    text: str = NOT_FINITE

    def met(self, world: World) -> Met | None:
        """Look at contacts."""
        refuse_contacts(world)
        return None


@dataclass
class Holds:
    """A condition on columns; the first entity that it holds of is told."""

    text: str
    condition: Condition

    def met(self, world: World) -> Met | None:
        """Evaluate it for each entity it speaks of."""
        there, holds, _ = self.condition.evaluate(world)
        if not (holds & there).any():
            return None
        index = int((holds & there).argmax())
        return Met(self.condition.values(world, index), tuple(map(world.find, self.condition.of(index))))


@dataclass
class Overlaps:
    """Colliders that overlap by more than ``bound`` (m)."""

    text: str
    bound: float

    def met(self, world: World) -> Met | None:
        """Look at the depth of every contact."""
        contact = world[Contact]
        depth = contact.depth[: contact.count]
        if not len(depth) or not depth.max() > self.bound:
            return None
        row = int(depth.argmax())
        a, b = int(contact.a[row]), int(contact.b[row])
        return Met(f"{depth[row]:.3g} m between '{world.name(a)}' and '{world.name(b)}'", (a, b))


@dataclass
class Rises:
    """Energy that rises above the lowest so far by a share of the largest, or by an amount in J."""

    text: str
    share: float = 0.0
    amount: float = 0.0
    _lowest: float = field(default=np.inf, init=False)
    _largest: float = field(default=0.0, init=False)

    def met(self, world: World) -> Met | None:
        """Measure the energy of all bodies."""
        kinetic, potential = kinetic_and_potential(world)
        total, largest = kinetic + potential, max(self._largest, abs(kinetic), abs(potential))
        if total - self._lowest > self.amount + self.share * largest:
            return Met(f"{total:.6g} J, {total - self._lowest:.3g} J above the lowest so far, {self._lowest:.6g} J")
        self._lowest, self._largest = min(self._lowest, total), largest
        return None


@dataclass
class AtFrame:
    """A frame, whatever happens in it."""

    text: str
    frame: int

    def met(self, world: World) -> Met | None:
        """Look at the number of the step."""
        return Met("is reached") if world.frame == self.frame else None


def read_break(text: str, world: World) -> Breakpoint:
    """Return the breakpoint a text states.

    Raises WordError for what is no condition, or asks for what the world does not have or for pictures.
    """
    stated = text.strip()
    if stated == NOT_FINITE:
        return NotFinite()
    if rises := RISES.fullmatch(stated):
        return _rises(stated, rises[1])
    if overlap := OVERLAP.fullmatch(stated):
        return Overlaps(stated, read_quantity(overlap[1], "m"))
    if frame := FRAME.fullmatch(stated):
        if int(frame[1]) < 1:
            raise WordError("is before the first step", received=repr(stated), accepted="a frame from 1 on")
        return AtFrame(stated, int(frame[1]))
    condition = read_condition(stated, world)
    if condition.looks:
        raise WordError("asks for a picture in every step", received=repr(text), accepted="conditions on columns")
    return Holds(stated, condition)


def break_when(simulation: Simulation, *texts: str, place: str = "break_when") -> list[Breakpoint]:
    """Let a simulation stop before a step is committed after which one of these holds; return the breakpoints.

    ``break_when(simulation, "speed(crate) > 20", "overlap > 1 cm")``; the next such step raises `StoppedError`, and a
    NaN is traced to the system that made it. Raises CaromError, which begins with ``place``, for what is no condition.
    """
    try:
        found = [read_break(text, simulation.world) for text in texts]
    except WordError as fault:
        raise CaromError(fault.line(place)) from None
    for breakpoint in found:
        breakpoint.met(simulation.world)  # what it compares with is from here on
    simulation.breakpoints += found
    return found


def _rises(text: str, amount: str) -> Rises:
    value = VALUE.fullmatch(amount)
    if value is not None and value[3] in ("", "%"):
        return Rises(text, share=read_quantity(amount, "1", least=0.0))
    return Rises(text, amount=read_quantity(amount, "J", least=0.0))
