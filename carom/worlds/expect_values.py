"""Expectations of values at a time, or at the moment of an event."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from carom.ecs import World
from carom.ecs.column import Floats
from carom.ecs.errors import did_you_mean
from carom.systems.simulation import Simulation
from carom.worlds.errors import WordError, shown
from carom.worlds.expect_moment import AtMoment, Event
from carom.worlds.expectation import Expectation
from carom.worlds.term import Term
from carom.worlds.terms import read_term
from carom.worlds.units import VALUE, read_quantity


@dataclass(frozen=True)
class Target:
    """The value (size,) that something must be, and how far it may be from it, both in ``unit``."""

    value: Floats
    within: float
    unit: str

    @property
    def text(self) -> str:
        """What it must be, in words."""
        return f"{numbers(self.value)} {self.unit} within {self.within:.3g}"

    def errors(self, values: Floats) -> Floats:
        """Return how far each row of ``values`` (n, size) is from it."""
        return np.asarray(np.linalg.norm(values - self.value, axis=1))


def read_target(words: Any, unit: str, size: int) -> Target:
    """Return the target of ``{is, within}``; raise WordError."""
    stated = words.value if isinstance(words.value, list) else [words.value]
    if len(stated) != size or (size > 1) is not isinstance(words.value, list):
        wanted = "one number" if size == 1 else f"a list of {size} numbers"
        raise WordError(f"'is' must be {wanted}", received=shown(words.value), accepted=f"numbers in {unit}")
    value = np.array([read_quantity(part, unit) for part in stated])
    found = VALUE.fullmatch(words.within) if isinstance(words.within, str) else None
    if found is not None and found[3] == "%" and unit != "1":
        return Target(value, read_quantity(words.within, "1", least=0.0) * float(np.linalg.norm(value)), unit)
    return Target(value, read_quantity(words.within, unit, least=0.0), unit)


def numbers(values: Floats) -> str:
    """Return one number or a list as text."""
    parts = [f"{value:.9g}" for value in np.atleast_1d(values)]
    return parts[0] if len(parts) == 1 else f"[{', '.join(parts)}]"


class Values(AtMoment):
    """What a term, or a column of the event's row, must be at a frame or an event."""

    def __init__(
        self, key: str, words: Any, world: World, *, frame: int | None = None, when: Event | None = None
    ) -> None:
        self.column = key
        self.found: Floats | None = None  # what failed
        self.term: Term | None = None
        columns = when.kind.columns if when is not None else {}
        told = {name: column for name, column in columns.items() if column.dtype.kind == "f"}
        if key in told:
            unit, size = told[key].unit, int(np.prod(told[key].shape))
        elif told and not any(mark in key for mark in ".("):
            accepted, hint = f"{', '.join(told)} or <entity>.<column>", did_you_mean(key, told)
            raise WordError("is nothing the event tells", received=repr(key), accepted=accepted, hint=hint)
        else:
            self.term = read_term(key, world)
            unit, size = self.term.unit, self.term.size
        self.target = read_target(words, unit, size)
        super().__init__(key, f"{key} {self.target.text}", frame, when)
        self.looks = self.term is not None and self.term.looks

    def compare(self, simulation: Simulation, row: int | None) -> None:
        """Compare the values with the target; a row is that of the event."""
        world, of = simulation.world, tuple[str, ...]()
        if self.term is None:
            assert self.when is not None and row is not None
            name, value = self.column, np.ravel(getattr(world[self.when.kind], self.column)[row])
            of = tuple(map(world.name, self.when.parties(world, row)))
        elif (there := self.term.there(world)).any():
            values = self.term.read(world)
            index = int(np.argmax(np.where(there, self.target.errors(values), -np.inf)))
            name, value, of = self.term.names[index], values[index], tuple(filter(None, [self.term.of(index)]))
        else:
            self.worst = self.term.absence(world)
            self.fail(simulation, self.worst)
            return
        error = float(self.target.errors(value[None])[0])
        self.worst = f"{name} = {numbers(value)} {self.target.unit}, off by {error:.3g}"
        if not error <= self.target.within:
            self.found = value
            self.fail(simulation, self.worst, of)

    def fails_like(self, other: Expectation) -> bool:
        """Tell whether both have failed of the same, by values that are the same as far as this can tell."""
        if not super().fails_like(other) or not isinstance(other, Values):
            return False
        if self.found is None or other.found is None:
            return self.found is other.found
        return bool(np.linalg.norm(self.found - other.found) <= self.target.within)


def read_values(words: dict[str, Any], world: World, **moment: Any) -> Iterable[tuple[str, Expectation | WordError]]:
    """Yield each key with its expectation, or with what is wrong with it."""
    for key, measure in words.items():
        try:
            yield key, Values(key, measure, world, **moment)
        except WordError as fault:
            yield key, fault
