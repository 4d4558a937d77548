"""Quantities: numbers with a dimension, which arithmetic keeps right."""

from __future__ import annotations

import math

from carom.worlds.errors import WordError

Dimension = tuple[int, int, int, int, int]  # powers of kg, m, s, rad, px
SI = ("kg", "m", "s", "rad", "px")
NONE: Dimension = (0, 0, 0, 0, 0)
METRE, RADIAN = SI.index("m"), SI.index("rad")
LARGEST_POWER = 9  # of a unit: what a file can write
WHOLE = 2.0**53  # beyond, a float does not tell whole numbers apart


class Quantity(float):
    """A number in SI units that knows its dimension; numbers of a file without a unit are plain ones."""

    dimension: Dimension

    def __new__(cls, value: float, dimension: Dimension = NONE) -> Quantity:
        """Make it of a value in SI units."""
        made = super().__new__(cls, value)
        made.dimension = dimension
        return made

    @property
    def unit(self) -> str:
        """Its unit as files write it, such as ``kg m2/s2``."""
        powers = list(zip(SI, self.dimension, strict=True))
        over = " ".join(_power(name, power) for name, power in powers if power > 0)
        return over + "".join(f"/{_power(name, -power)}" for name, power in powers if power < 0)

    def __repr__(self) -> str:
        """Return the number with its unit, as a file could write it."""
        return f"{in_words(float(self))} {self.unit}"

    __str__ = __repr__


def _power(name: str, power: int) -> str:
    return name if power == 1 else f"{name}{power}"


def in_words(number: float) -> str:
    """Return a number in the shortest digits that mean it."""
    return repr(number).removesuffix(".0")


def dimension_of(number: float) -> Dimension:
    """Return the dimension of a number; plain ones have none."""
    return number.dimension if isinstance(number, Quantity) else NONE


def quantity(value: float, dimension: Dimension) -> float:
    """Return a quantity, or a plain number where it has no dimension, an int where it is whole.

    Of lengths with angles only the length is left, as arc is radius times angle. Raises WordError beyond all bounds.
    """
    if not math.isfinite(value):
        raise WordError("makes a number beyond all bounds")
    if dimension[METRE]:
        dimension = _without_angle(dimension)
    if max(map(abs, dimension)) > LARGEST_POWER:
        raise WordError(f"makes a unit to a power above {LARGEST_POWER}")
    if dimension != NONE:
        return Quantity(value, dimension)
    return int(value) if float(value).is_integer() and abs(value) < WHOLE else float(value)


def common(a: Dimension, b: Dimension) -> Dimension | None:
    """Return the dimension of what can be added or compared: the same, or but for rad, which is a ratio of lengths."""
    if a == b:
        return a
    longer = max(a, b, key=lambda dimension: abs(dimension[RADIAN]))
    return longer if fits(a, b) or fits(b, a) else None


def fits(given: Dimension, wanted: Dimension) -> bool:
    """Tell whether a value of one dimension can stand where another is wanted; ratios of lengths are angles in rad."""
    return given == wanted or (given[RADIAN] == 0 and given == _without_angle(wanted))


def _without_angle(dimension: Dimension) -> Dimension:
    kg, m, s, _, px = dimension
    return kg, m, s, 0, px
