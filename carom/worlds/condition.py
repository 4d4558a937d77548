"""Conditions of expectations: comparisons of terms and values with units, joined by and, or, not. No code is run."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce
from typing import ClassVar, NamedTuple

import numpy as np

from carom.ecs import World
from carom.ecs.column import Booleans, Floats
from carom.worlds.errors import WordError
from carom.worlds.parsing import Parser
from carom.worlds.term import Term
from carom.worlds.terms import TERM_PATTERN, read_term
from carom.worlds.units import NUMBER, read_quantity

END = r"(?=\s*(?:$|[<>=!)]|and\b|or\b))"
TOKEN = re.compile(
    rf"\s*(?:(?P<mark><=|>=|==|!=|<|>|[()])|(?P<word>(?:and|or|not)\b)"
    rf"|(?P<value>{NUMBER}(?:\s*/\s*{NUMBER})?(?:\s*(?!and\b|or\b)[A-Za-z%/][\w%^*/ ]*?)?{END})"
    rf"|(?P<term>{TERM_PATTERN}))"
)
COMPARE: dict[str, Callable[[Floats, Floats], Booleans]] = {
    "<": np.less, "<=": np.less_equal, ">": np.greater, ">=": np.greater_equal, "==": np.equal, "!=": np.not_equal
}  # fmt: skip
FORM = "comparisons such as 'left.position.y < 0', 'speed(left) > 3 m/s', joined by and, or, not"


class Verdict(NamedTuple):
    """For each entity a condition speaks of: whether it is there, whether it holds, by how much (positive if so)."""

    there: Booleans
    holds: Booleans
    margin: Floats


class Compared(NamedTuple):
    """Whether a part of a condition holds for each, and by how much."""

    holds: Booleans
    margin: Floats


Evaluate = Callable[[World], Compared]


@dataclass(frozen=True)
class Condition:
    """A parsed condition; where its terms are of several entities it is one condition for each.

    It is asked of those of whom all of its terms are there.
    """

    text: str
    terms: tuple[Term, ...]
    compare: Evaluate

    @property
    def looks(self) -> bool:
        """Whether it asks for pictures."""
        return any(term.looks for term in self.terms)

    def evaluate(self, world: World) -> Verdict:
        """Return what holds now."""
        there = reduce(np.logical_and, (term.there(world) for term in self.terms))
        holds, margin = self.compare(world)
        if there.shape != holds.shape:
            there = np.broadcast_to(there, holds.shape)
        return Verdict(there, holds, margin)

    def of(self, index: int) -> tuple[str, ...]:
        """Return whom its terms are of where it speaks of one of the entities."""
        names = (term.of(index % len(term.names)) for term in self.terms)
        return tuple(dict.fromkeys(name for name in names if name))

    def values(self, world: World, index: int) -> str:
        """Return what its terms are for one of the entities."""
        shown = []
        for term in dict.fromkeys(self.terms):
            at = min(index, len(term.names) - 1)
            shown.append(f"{term.names[at]} = {float(term.read(world)[at, 0]):.9g} {term.unit}")
        return ", ".join(shown)

    def absence(self, world: World, index: int | None = None) -> str:
        """Say who of all of whom it speaks, or of whom one of its values is, is not there."""
        told = (term.absence(world, index) for term in self.terms)
        return ", ".join(dict.fromkeys(filter(None, told)))


def read_condition(text: str, world: World) -> Condition:
    """Return the condition a text states; raise WordError."""
    parser = _Conditions(text, world)
    evaluate = parser.either(0)
    parser.end()
    counts = {len(term.names) for term in parser.terms} - {1}
    if len(counts) > 1:
        accepted = "patterns that mean equally many"
        raise WordError("compares different numbers of entities", received=repr(text), accepted=accepted)
    return Condition(text, tuple(parser.terms), evaluate)


class _Conditions(Parser):
    """Or binds loosest, then and, then not, then comparisons."""

    TOKEN, KIND, FORM = TOKEN, "condition", FORM
    MEANT: ClassVar[dict[str, str]] = {"=<": "<=", "=>": ">=", "=": "==", "&": "and", "|": "or"}

    def __init__(self, text: str, world: World) -> None:
        super().__init__(text)
        self.world = world
        self.terms: list[Term] = []

    def either(self, depth: int) -> Evaluate:
        parts = [self.both(depth)]
        while self.take("or"):
            parts.append(self.both(depth))
        return parts[0] if len(parts) == 1 else _joined(parts, np.logical_or, np.maximum)

    def both(self, depth: int) -> Evaluate:
        parts = [self.negated(depth)]
        while self.take("and"):
            parts.append(self.negated(depth))
        return parts[0] if len(parts) == 1 else _joined(parts, np.logical_and, np.minimum)

    def negated(self, depth: int) -> Evaluate:
        turned = False
        while self.take("not"):
            turned = not turned
        inner = self.comparison(depth)
        return (lambda world: Compared(~(found := inner(world)).holds, -found.margin)) if turned else inner

    def comparison(self, depth: int) -> Evaluate:
        if self.take("("):
            inner = self.either(self.enter(depth))
            self.close()
            return inner
        operands, marks = [self.operand()], []
        while mark := self.take(*COMPARE):
            marks.append(mark)
            operands.append(self.operand())
        if not marks:
            raise self.fault("compares nothing")
        unit = next((term.unit for term in operands if isinstance(term, Term)), None)
        if unit is None:
            raise self.fault("compares only numbers")
        reads = [self.reading(operand, unit) for operand in operands]
        parts = [_compared(reads[i], mark, reads[i + 1]) for i, mark in enumerate(marks)]
        return parts[0] if len(parts) == 1 else _joined(parts, np.logical_and, np.minimum)

    def operand(self) -> Term | str:
        if not self.tokens or self.tokens[0][0] not in ("value", "term"):
            raise self.fault("lacks a value")
        group, text = self.tokens.pop(0)
        if group == "value":
            return text
        term = read_term(text, self.world)
        if term.size > 1:
            accepted = f"one component, such as {term.text}.x"
            raise WordError(f"{term.text} has {term.size} components", received=repr(self.text), accepted=accepted)
        self.terms.append(term)
        return term

    def reading(self, operand: Term | str, unit: str) -> Callable[[World], Floats]:
        if isinstance(operand, str):
            value = np.array([read_quantity(operand, unit)])
            return lambda world: value
        if operand.unit != unit:
            raise self.fault(f"compares {operand.text} in {operand.unit} with a value in {unit}")
        return lambda world: operand.read(world)[:, 0]


def _compared(left: Callable[[World], Floats], mark: str, right: Callable[[World], Floats]) -> Evaluate:
    def evaluate(world: World) -> Compared:
        a, b = left(world), right(world)
        room = b - a if mark in ("<", "<=") else a - b if mark in (">", ">=") else np.abs(a - b)
        return Compared(COMPARE[mark](a, b), -room if mark == "==" else room)

    return evaluate


def _joined(parts: list[Evaluate], holds: np.ufunc, margin: np.ufunc) -> Evaluate:
    def evaluate(world: World) -> Compared:
        found = [part(world) for part in parts]
        total = found[0]
        for verdict in found[1:]:
            total = Compared(holds(total.holds, verdict.holds), margin(total.margin, verdict.margin))
        return total

    return evaluate
