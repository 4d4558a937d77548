"""Values with units: ``45 deg``, ``9 ft``, ``1/240``, ``30 km/h``, checked against the unit a place declares."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from functools import cache, lru_cache
from typing import Any, NamedTuple

from carom.ecs.errors import did_you_mean
from carom.worlds.errors import WordError, shown
from carom.worlds.quantity import Dimension, Quantity, fits, quantity

LONGEST_VALUE = 80  # characters: longer texts are no numbers, and their fractions would grow without bound


class Unit(NamedTuple):
    """A unit as a multiple of SI units; exact, so that ``57.15 mm`` is the float nearest 0.05715."""

    factor: Fraction
    dimension: Dimension


PURE = Unit(Fraction(1), (0, 0, 0, 0, 0))
DEGREE = Fraction(math.pi) / 180
BASE: dict[str, tuple[Dimension, Mapping[str, Fraction | int | str]]] = {
    "a mass": (
        (1, 0, 0, 0, 0),
        {"kg": 1, "g": "0.001", "mg": "1e-6", "t": 1000, "lb": "0.45359237", "oz": "0.028349523125"},
    ),
    "a length": (
        (0, 1, 0, 0, 0),
        {
            "m": 1,
            "mm": "0.001",
            "cm": "0.01",
            "km": 1000,
            "um": "1e-6",
            "in": "0.0254",
            "ft": "0.3048",
            "mi": "1609.344",
        },
    ),
    "a time": ((0, 0, 1, 0, 0), {"s": 1, "ms": "0.001", "us": "1e-6", "min": 60, "h": 3600, "d": 86400}),
    "an angle": ((0, 0, 0, 1, 0), {"rad": 1, "deg": DEGREE, "mrad": "0.001", "turn": DEGREE * 360}),
    "a number of pixels": ((0, 0, 0, 0, 1), {"px": 1}),
    "a number": ((0, 0, 0, 0, 0), {"%": "0.01"}),
    "a frequency": ((0, 0, -1, 0, 0), {"Hz": 1}),
    "an angular velocity": ((0, 0, -1, 1, 0), {"rpm": DEGREE * 6}),
    "a speed": ((0, 1, -1, 0, 0), {"mph": "0.44704", "kn": Fraction(1852, 3600)}),
    "a force": ((1, 1, -2, 0, 0), {"N": 1, "mN": "0.001", "kN": 1000, "MN": 1000000, "lbf": "4.4482216152605"}),
    "an energy": ((1, 2, -2, 0, 0), {"J": 1, "mJ": "0.001", "kJ": 1000, "MJ": 1000000}),
    "a power": ((1, 2, -3, 0, 0), {"W": 1, "kW": 1000}),
    "a pressure": ((1, -1, -2, 0, 0), {"Pa": 1, "kPa": 1000, "MPa": 1000000}),
}
UNITS = {name: Unit(Fraction(factor), dim) for dim, names in BASE.values() for name, factor in names.items()}
COMPOUND = ("m/s", "km/h", "ft/s", "m/s2", "ft/s2", "rad/s", "deg/s", "turn/s", "N s", "N m", "kg/m3", "g/cm3", "kg/s")

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?"
VALUE = re.compile(rf"\s*({NUMBER})(?:\s*/\s*({NUMBER}))?\s*(.*?)\s*")
TOKEN = re.compile(r"\s*(?:([A-Za-z%]+)(?:\^?(-?\d))?|(1)|([/()*]))")


def read_quantity(
    value: Any, unit: str, *, above: float | None = None, least: float | None = None, most: float | None = None
) -> float:
    """Return a number of a file in ``unit`` (SI); plain numbers are taken as they are.

    Raises WordError for what is no number, not finite, of another dimension, or out of bounds.
    """
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise WordError(f"must be {kind_of(unit)}", received=shown(value), accepted=accepted(unit))
    if isinstance(value, Quantity) and not fits(value.dimension, parse_unit(unit).dimension):
        received = f"{shown(value)}, which is {kind_of(value.unit)}"
        raise WordError(f"must be {kind_of(unit)}", received=received, accepted=accepted(unit))
    number = _parse(value, unit) if isinstance(value, str) else float(value)
    if not math.isfinite(number):
        raise WordError("must be finite", received=shown(value), accepted=accepted(unit))
    short = "" if unit == "1" else f" {unit}"
    if above is not None and not number > above:
        raise WordError(f"must be above {above:g}{short}", received=shown(value))
    if least is not None and not number >= least:
        raise WordError(f"must be at least {least:g}{short}", received=shown(value))
    if most is not None and not number <= most:
        raise WordError(f"must be at most {most:g}{short}", received=shown(value))
    return number


@lru_cache(4096)
def _parse(text: str, unit: str) -> float:
    found = VALUE.fullmatch(text) if len(text) <= LONGEST_VALUE else None
    if found is None:
        raise WordError(f"is not {kind_of(unit)}", received=shown(text), accepted=accepted(unit))
    over, under, name = found.groups()
    try:
        given = parse_unit(name or unit)
    except WordError as fault:
        fault.received, fault.accepted = shown(text), accepted(unit)
        raise
    if given.dimension != parse_unit(unit).dimension:
        received = f"{shown(text)}, which is {kind_of(name)}"
        raise WordError(f"must be {kind_of(unit)}", received=received, accepted=accepted(unit))
    return _exact(text, over, under, given.factor if name else 1)


def _exact(text: str, over: str, under: str | None, factor: Fraction | int) -> float:
    dividend, share = Decimal(over).as_integer_ratio()
    divisor, parts = Decimal(under or 1).as_integer_ratio()
    if not divisor:
        raise WordError("divides by zero", received=shown(text))
    try:  # a quotient of whole numbers is the float nearest to it
        return (dividend * parts * factor.numerator) / (share * divisor * factor.denominator)
    except OverflowError:
        return math.inf


def read_any(text: str) -> float | None:
    """Return the number of a text in whatever unit it states, None where it does not begin with a number.

    Raises WordError for a unit that is not known.
    """
    found = VALUE.fullmatch(text) if len(text) <= LONGEST_VALUE else None
    if found is None:
        return None
    over, under, name = found.groups()
    try:
        unit = parse_unit(name)
    except WordError as fault:
        fault.received = shown(text)
        raise
    return quantity(_exact(text, over, under, unit.factor), unit.dimension)


@cache
def parse_unit(text: str) -> Unit:
    """Return a unit written as ``kg m2/s2`` or ``1/(kg m2)``: blank or * multiplies, / divides by what follows it."""
    if text in UNITS:
        return UNITS[text]
    unit, at, sign, levels = PURE, 0, 1, [1]
    while at < len(text):
        found = TOKEN.match(text, at)
        if found is None:
            raise _unknown(text)
        at = found.end()
        name, power, _, mark = found.groups()
        if mark == "/":
            sign = -1
        elif mark == "(":
            levels.append(levels[-1] * sign)
            sign = 1
        elif mark == ")" and len(levels) > 1:
            levels.pop()
        elif mark == ")" or (name and name not in UNITS):
            raise _unknown(name or text)
        elif name:
            exponent, named = levels[-1] * sign * int(power or 1), UNITS[name]
            unit = Unit(unit.factor * named.factor**exponent, _sum(unit.dimension, named.dimension, exponent))
            sign = 1
    return unit


def _sum(a: Dimension, b: Dimension, times: int) -> Dimension:
    kg, m, s, rad, px = (one + other * times for one, other in zip(a, b, strict=True))
    return kg, m, s, rad, px


def _unknown(name: str) -> WordError:
    return WordError(f"unknown unit {name!r}", hint=did_you_mean(name, UNITS))


def kind_of(unit: str) -> str:
    """Return what a unit measures, in words: ``a length``; a torque has the dimension of an energy."""
    if unit == "N m":
        return "a torque"
    dimension = parse_unit(unit).dimension
    return next((word for word, (known, _) in BASE.items() if known == dimension), f"a value in {unit}")


def accepted(unit: str) -> str:
    """Return the sentence on what a place with this unit takes."""
    dimension = parse_unit(unit).dimension
    names = [unit, *(name for name in (*UNITS, *COMPOUND) if name != unit and parse_unit(name).dimension == dimension)]
    return "a number" if unit == "1" else f"a number in {unit}, or one with a unit: {', '.join(names)}"
