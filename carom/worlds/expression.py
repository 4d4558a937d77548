"""Expressions of world files: arithmetic over variables, numbers with units and a few functions. No code is run."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence

from carom.ecs.errors import did_you_mean
from carom.ecs.spatial.trigonometry import LARGEST_EXPONENT as LARGEST_EXPONENT_OF_E
from carom.ecs.spatial.trigonometry import exponential, sine_cosine
from carom.worlds.errors import WordError
from carom.worlds.parsing import Parser
from carom.worlds.quantity import NONE, Dimension, common, dimension_of, quantity
from carom.worlds.units import kind_of, read_any

LONGEST = 200  # characters
LARGEST_EXPONENT = 16
LARGEST_ANGLE = 1e6  # rad: beyond, sines lose their digits
NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?"
UNIT = r"[A-Za-z%]+(?:\^?-?\d)?"
ANGLE: Dimension = (0, 0, 0, 1, 0)
LookUp = Callable[[str], object]


def evaluate(text: str, look_up: LookUp) -> object:
    """Return what an expression comes to: a number, a `Quantity`, or a variable's text or list where it is only that.

    Raises WordError with the text it was given.
    """
    if len(text) > LONGEST:
        raise WordError(f"is longer than an expression may be, {LONGEST} characters", received=repr(text[:40] + "..."))
    parser = _Arithmetic(text, look_up)
    try:
        value = parser.sum(0)
    except WordError as fault:
        fault.received = fault.received or repr(text)
        raise
    parser.end()
    return value


class _Arithmetic(Parser):
    """Sums bind loosest, then products, then signs, then powers."""

    # A unit follows its number, or quotient of numbers, its own divisions without blanks: 30 km/h, but 30 km / time.
    TOKEN = re.compile(
        rf"\s*(?:(?P<value>{NUMBER}(?:\s*/\s*{NUMBER}(?=\s*{UNIT}))?(?:\s*{UNIT}(?:(?: |[/*]){UNIT})*)?)"
        r"|(?P<name>[^\W\d]\w*(?:\.\w+)*)|(?P<mark>\*\*|[-+*/(),]))"
    )
    KIND = "expression"
    FORM = "numbers with units, variables, + - * / ** ( ), pi, sqrt, abs, min, max, round, sin, cos, tan, exp"

    def __init__(self, text: str, look_up: LookUp) -> None:
        super().__init__(text)
        self.look_up = look_up

    def sum(self, depth: int) -> object:
        value = self.product(depth)
        while sign := self.take("+", "-"):
            a, b = self.number(value), self.number(self.product(depth))
            value = quantity(a + b if sign == "+" else a - b, _same("adds", (a, b)))
        return value

    def product(self, depth: int) -> object:
        value = self.signed(depth)
        while sign := self.take("*", "/"):
            a, b = self.number(value), self.number(self.signed(depth))
            value = _multiplied(a, b) if sign == "*" else _divided(a, b)
        return value

    def signed(self, depth: int) -> object:
        signs = 0
        while sign := self.take("-", "+"):
            signs += sign == "-"
        value = self.power(depth)
        if not signs:
            return value
        number = self.number(value)
        return quantity(-float(number) if signs % 2 else number, dimension_of(number))

    def power(self, depth: int) -> object:
        base = self.atom(depth)
        if not self.take("**"):
            return base
        return _power(self.number(base), self.number(self.signed(self.enter(depth))))

    def atom(self, depth: int) -> object:
        if self.take("("):
            inner = self.sum(self.enter(depth))
            self.close()
            return inner
        if not self.tokens or self.tokens[0][0] == "mark":
            raise self.fault("lacks a value")
        kind, text = self.tokens.pop(0)
        if kind == "value":
            return read_any(text)
        if self.take("("):
            return self.call(text, self.enter(depth))
        return math.pi if text == "pi" else self.look_up(text)

    def call(self, name: str, depth: int) -> float:
        given = [self.number(self.sum(depth))]
        while self.take(","):
            given.append(self.number(self.sum(depth)))
        self.close()
        if name not in FUNCTIONS:
            hint = did_you_mean(name, FUNCTIONS)
            raise WordError(f"unknown function {name!r}", accepted=", ".join(FUNCTIONS), hint=hint)
        if name not in SEVERAL and len(given) > 1:
            raise WordError(f"{name} takes one value", accepted=f"{name}(value)")
        return FUNCTIONS[name](given)

    def number(self, value: object) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise self.fault("computes with what is no number")
        return value


def _same(what: str, numbers: Sequence[float]) -> Dimension:
    """Return the dimension that all numbers share."""
    dimension = dimension_of(numbers[0])
    for number in numbers[1:]:
        shared = common(dimension, dimension_of(number))
        if shared is None:
            kinds = f"{_kind(numbers[0])} and {_kind(number)}"
            raise WordError(f"{what} {kinds}", hint="state the unit of each")
        dimension = shared
    return dimension


def _kind(number: float) -> str:
    return kind_of(getattr(number, "unit", "1"))


def _multiplied(a: float, b: float) -> float:
    powers = zip(dimension_of(a), dimension_of(b), strict=True)
    return quantity(float(a) * float(b), tuple(one + other for one, other in powers))  # type: ignore[arg-type]


def _divided(a: float, b: float) -> float:
    if b == 0:
        raise WordError("divides by zero")
    powers = zip(dimension_of(a), dimension_of(b), strict=True)
    return quantity(float(a) / float(b), tuple(one - other for one, other in powers))  # type: ignore[arg-type]


def _power(base: float, exponent: float) -> float:
    """Multiply as often as the exponent says: libm's powers differ by machine in their last bit."""
    if dimension_of(exponent) != NONE or not isinstance(exponent, int) or abs(exponent) > LARGEST_EXPONENT:
        raise WordError(f"raises to what is no whole number from -{LARGEST_EXPONENT} to {LARGEST_EXPONENT}")
    result: float = 1
    for _ in range(abs(exponent)):
        result = _multiplied(result, base)
    return result if exponent >= 0 else _divided(1, result)


def _root(given: Sequence[float]) -> float:
    dimension = dimension_of(given[0])
    if given[0] < 0 or any(power % 2 for power in dimension):
        raise WordError("takes the root of what is no square")
    kg, m, s, rad, px = (power // 2 for power in dimension)
    return quantity(math.sqrt(given[0]), (kg, m, s, rad, px))


def _turn(given: Sequence[float]) -> tuple[float, float]:
    if dimension_of(given[0]) not in (NONE, ANGLE) or abs(given[0]) > LARGEST_ANGLE:
        raise WordError("takes the sine, cosine or tangent of what is no angle", accepted="such as 30 deg")
    return sine_cosine(float(given[0]))


def _round(given: Sequence[float]) -> float:
    if dimension_of(given[0]) != NONE:
        raise WordError("rounds what is no plain number", accepted="such as round(length / 1 m)")
    return round(given[0])


def _exponential(given: Sequence[float]) -> float:
    if dimension_of(given[0]) != NONE or abs(given[0]) > LARGEST_EXPONENT_OF_E:
        raise WordError("takes e to what is no plain number", accepted=f"up to {LARGEST_EXPONENT_OF_E:g}")
    return quantity(exponential(float(given[0])), NONE)


SEVERAL = ("min", "max")
FUNCTIONS: dict[str, Callable[[Sequence[float]], float]] = {
    "sqrt": _root,
    "abs": lambda given: quantity(abs(float(given[0])), dimension_of(given[0])),
    "min": lambda given: quantity(float(min(given)), _same("compares", given)),
    "max": lambda given: quantity(float(max(given)), _same("compares", given)),
    "round": _round,
    "sin": lambda given: quantity(_turn(given)[0], NONE),
    "cos": lambda given: quantity(_turn(given)[1], NONE),
    "tan": lambda given: _divided(*_turn(given)),
    "exp": _exponential,
}
