"""Expectations of values at a time, or at the moment of an event."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from carom.ecs import Collider, World
from carom.ecs.column import Floats
from carom.ecs.component import Relation
from carom.ecs.errors import did_you_mean
from carom.ecs.relations.enter import Enter, Exit
from carom.ecs.relations.impact import Impact
from carom.systems.simulation import Simulation
from carom.worlds.errors import WordError, shown
from carom.worlds.expectation import Expectation
from carom.worlds.names import matching
from carom.worlds.terms import Term, read_term
from carom.worlds.units import VALUE, read_quantity

PARTIES: dict[type[Relation], tuple[str, str]] = {
    Impact: ("a", "b"),
    Enter: ("sensor", "entity"),
    Exit: ("sensor", "entity"),
}


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


@dataclass(frozen=True)
class Event:
    """A row of an event table: which one of those between two groups of entities."""

    kind: type[Relation]
    first: frozenset[int]
    second: frozenset[int]
    nth: int
    text: str

    def matching_rows(self, world: World) -> list[int]:
        """Return the rows of the last step that are such events; impacts count whichever of the two is named first."""
        table = world[self.kind]
        one, other = (getattr(table, name) for name in PARTIES[self.kind])
        pairs = [(int(one[row]), int(other[row])) for row in range(table.count)]
        swap = self.kind is Impact
        return [row for row, pair in enumerate(pairs) if self._fits(*pair) or (swap and self._fits(*pair[::-1]))]

    def _fits(self, one: int, other: int) -> bool:
        return one in self.first and other in self.second


def read_event(words: Any, world: World) -> Event:
    """Return the event of ``{impact: [a, b], nth}``, or of ``enter`` or ``exit: [sensor, entity]``; raise WordError."""
    ((kind, pair),) = ((kind, pair) for kind in PARTIES if (pair := getattr(words, kind.key)) is not None)
    groups = [frozenset(int(world.find(name)) for name in matching(pattern, world.names())) for pattern in pair]
    if kind is not Impact:
        plain = [world.name(entity) for entity in groups[0] if not world[Collider].sensor[world.row(entity)]]
        if plain:
            raise WordError("is no sensor", received=repr(plain[0]), accepted="a collider with sensor: true")
    text = f"{kind.key} {words.nth} of {pair[0]} and {pair[1]}"
    return Event(kind, groups[0], groups[1], words.nth, text)


class Values(Expectation):
    """What a term, or a column of the event's row, must be at a frame or an event."""

    def __init__(
        self, key: str, words: Any, world: World, *, frame: int | None = None, when: Event | None = None
    ) -> None:
        self.frame, self.when, self.column = frame, when, key
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
        self.seen = 0
        moment = when.text if when is not None else f"frame {frame}"
        super().__init__(f"{key} at {moment}", f"{key} {self.target.text}")

    def begin(self, simulation: Simulation) -> None:
        """Compare at time 0 where that is the time."""
        if self.frame == 0:
            self.compare(simulation, None)

    def observe(self, simulation: Simulation) -> None:
        """Compare when the moment has come."""
        if self.when is None:
            if simulation.frame == self.frame:
                self.compare(simulation, None)
            return
        for row in self.when.matching_rows(simulation.world) if self.seen < self.when.nth else ():
            self.seen += 1
            if self.seen == self.when.nth:
                self.compare(simulation, row)

    def compare(self, simulation: Simulation, row: int | None) -> None:
        """Compare the values with the target; a row is that of the event."""
        world = simulation.world
        if self.term is not None:
            values, names = self.term.read(world), self.term.names
        else:
            assert self.when is not None
            values, names = np.reshape(getattr(world[self.when.kind], self.column)[row], (1, -1)), (self.column,)
        errors = self.target.errors(values)
        index = int(np.argmax(errors))
        self.worst = f"{names[index]} = {numbers(values[index])} {self.target.unit}, off by {errors[index]:.3g}"
        if not errors[index] <= self.target.within:
            self.fail(simulation, self.worst)

    def end(self, simulation: Simulation) -> None:
        """Fail when the moment never came."""
        if self.worst:
            return
        if self.when is not None:
            self.fail(simulation, f"{self.seen} of {self.when.nth} such events by the end of the run")
        else:
            self.fail(simulation, f"the run ended at frame {simulation.frame}, before frame {self.frame}")


def frame_of(time: float, dt: float) -> int:
    """Return the step that ends at ``time``; raise WordError when none does."""
    frame = round(time / dt)
    if abs(frame * dt - time) > 1e-9 * max(time, dt):
        accepted = f"a multiple of dt = {dt:.9g} s, such as {frame * dt:.9g} s"
        raise WordError("is between two steps", received=f"{time:g} s", accepted=accepted)
    return frame


def read_values(words: dict[str, Any], world: World, **moment: Any) -> Iterable[tuple[str, Expectation | WordError]]:
    """Yield each key with its expectation, or with what is wrong with it."""
    for key, measure in words.items():
        try:
            yield key, Values(key, measure, world, **moment)
        except WordError as fault:
            yield key, fault
