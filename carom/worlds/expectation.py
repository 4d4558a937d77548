"""Expectation: the base of everything a world file can expect, and what became of it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from carom.systems.simulation import Simulation
from carom.worlds.errors import Path

NUMBERS = re.compile(r"\[[\d,]+\]|(?<![\w.-])(?:[-+]?\d[\d.]*(?:e[-+]?\d+)?|nan|-?inf)")


@dataclass(frozen=True)
class Outcome:
    """What became of an expectation: ``frame`` and ``time`` (s) are where it first failed, None where it held.

    ``entities`` are the names of those of whom it failed, as far as it is of some; ``file`` is where it is written.
    """

    text: str
    held: bool
    expected: str
    received: str
    worst: str
    frame: int | None = None
    time: float | None = None
    entities: tuple[str, ...] = ()
    file: str = ""

    def __str__(self) -> str:
        """Return one line."""
        if self.held:
            return f"held: {self.text} ({self.worst})" if self.worst else f"held: {self.text}"
        where = "" if self.frame is None else f" in frame {self.frame} at {self.time:.6g} s"
        return f"failed{where}: {self.text}; expected {self.expected}; received {self.received}; worst {self.worst}"


class Expectation:
    """Something that must hold while a world runs; `observe` looks after every step and calls `fail`.

    ``looks`` is whether it asks for pictures.
    """

    looks = False
    file = ""  # where it is written: file, line and column
    path: Path = ()  # in the file

    def __init__(self, text: str, expected: str) -> None:
        self.text, self.expected = text, expected
        self.worst = ""
        self.failure: tuple[str, int, float] | None = None
        self.entities: tuple[str, ...] = ()  # of whom it failed

    def begin(self, simulation: Simulation) -> None:
        """See the world before its first step."""

    def observe(self, simulation: Simulation) -> None:
        """See the world after a step."""

    def end(self, simulation: Simulation) -> None:
        """See the end of the run."""

    def fail(self, simulation: Simulation, received: str, entities: Iterable[str] = ()) -> None:
        """Note a failure, of these entities (names) where it is of some; the first one counts."""
        if self.failure is None:
            self.failure = (received, simulation.frame, simulation.time)
            self.entities = tuple(dict.fromkeys(entities))

    @property
    def held(self) -> bool:
        """Whether it held so far."""
        return self.failure is None

    @property
    def settled(self) -> bool:
        """Whether nothing that is still to come can change what becomes of it."""
        return self.failure is not None

    def fails_like(self, other: Expectation) -> bool:
        """Tell whether this and another, perhaps of another world, have failed of the same: in words and in manner.

        The manner is what was received, but for numbers and those of copies: another two that overlap, or a strike that
        never comes where one came at a wrong time, are another failure.
        """
        if self.failure is None or other.failure is None:
            return False
        same = (self.text, self.expected) == (other.text, other.expected)
        return same and NUMBERS.sub("", self.failure[0]) == NUMBERS.sub("", other.failure[0])

    def outcome(self) -> Outcome:
        """Return what became of it."""
        if self.failure is None:
            return Outcome(self.text, True, self.expected, self.worst, self.worst, file=self.file)
        received, frame, time = self.failure
        worst = self.worst or received
        return Outcome(self.text, False, self.expected, received, worst, frame, time, self.entities, self.file)
