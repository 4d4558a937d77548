"""Values with units become the nearest float in SI, or say what they should have been."""

from __future__ import annotations

import contextlib
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from carom.worlds.errors import WordError
from carom.worlds.units import UNITS, kind_of, parse_unit, read_quantity


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("45 deg", "rad", math.pi / 4),
        ("9 ft", "m", 2.7432),
        ("170 g", "kg", 0.17),
        ("1/240", "s", 1 / 240),
        ("1/240 s", "s", 1 / 240),
        ("57.15 mm", "m", 0.05715),
        ("57.15mm", "m", 0.05715),
        ("8 m/s", "m/s", 8.0),
        ("30 km/h", "m/s", 30 / 3.6),
        ("2.5 s", "s", 2.5),
        ("1 N", "N", 1.0),
        ("50 rad/s", "rad/s", 50.0),
        ("60 rpm", "rad/s", 2 * math.pi),
        ("1 g/cm^3", "kg/m3", 1000.0),
        ("6.6743e-11 N m2/kg2", "m3/(kg s2)", 6.6743e-11),
        ("5 %", "1", 0.05),
        (3, "m", 3.0),
        (2.5, "kg", 2.5),
    ],
)
def test_values(text: object, unit: str, value: float) -> None:
    """Values are exact: the float nearest to what the text says."""
    assert read_quantity(text, unit) == value


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e30, max_value=1e30))
def test_a_text_in_the_declared_unit_is_the_number_itself(number: float) -> None:
    """The declared unit changes nothing."""
    assert read_quantity(f"{number!r} m", "m") == number == read_quantity(number, "m")


@given(st.sampled_from(sorted(UNITS)), st.sampled_from(sorted(UNITS)))
def test_products_and_quotients_of_units_cancel(first: str, second: str) -> None:
    """A unit over itself is a pure 1."""
    unit = parse_unit(f"{first} {second}/({first} {second})")
    assert (unit.factor, unit.dimension) == (1, (0, 0, 0, 0, 0))


@given(st.sampled_from(sorted(UNITS)), st.sampled_from(["m", "kg", "s", "rad", "N", "J", "m/s", "1"]))
def test_only_units_of_the_same_dimension_are_taken(given_unit: str, wanted: str) -> None:
    """A unit of another dimension is refused, one of the same multiplies."""
    fits = parse_unit(given_unit).dimension == parse_unit(wanted).dimension
    if fits:
        assert read_quantity(f"2 {given_unit}", wanted) == float(2 * parse_unit(given_unit).factor)
    else:
        with pytest.raises(WordError, match=f"must be {kind_of(wanted)}"):
            read_quantity(f"2 {given_unit}", wanted)


@given(st.text(max_size=100))
def test_any_text_is_a_number_or_a_fault(text: str) -> None:
    """No text leads to NaN, infinity or an exception of Python."""
    with contextlib.suppress(WordError):
        assert math.isfinite(read_quantity(text, "m"))


@pytest.mark.parametrize(
    ("value", "unit", "what", "received", "accepted"),
    [
        (
            "3 kg",
            "s",
            "must be a time",
            "'3 kg', which is a mass",
            "a number in s, or one with a unit: s, ms, us, min, h, d",
        ),
        ("3 sek", "s", "unknown unit 'sek'", "'3 sek'", "a number in s, or one with a unit: s, ms, us, min, h, d"),
        ("soon", "s", "is not a time", "'soon'", "a number in s, or one with a unit: s, ms, us, min, h, d"),
        (True, "1", "must be a number", "true", "a number"),
        (None, "1", "must be a number", "nothing", "a number"),
        ([1], "1", "must be a number", "[1]", "a number"),
        (math.nan, "1", "must be finite", "nan", "a number"),
        (-math.inf, "1", "must be finite", "-inf", "a number"),
        ("1e999 kg", "1", "must be a number", "'1e999 kg', which is a mass", "a number"),
        ("1e999", "1", "must be finite", "'1e999'", "a number"),
        ("1/0", "s", "divides by zero", "'1/0'", ""),
    ],
)
def test_faults(value: object, unit: str, what: str, received: str, accepted: str) -> None:
    """What was received and what is accepted are said."""
    with pytest.raises(WordError) as caught:
        read_quantity(value, unit)
    assert (caught.value.what, caught.value.received, caught.value.accepted) == (what, received, accepted)


def test_bounds() -> None:
    """Bounds are inclusive but for above."""
    with pytest.raises(WordError, match=r"^must be above 0 kg$"):
        read_quantity("0 g", "kg", above=0.0)
    with pytest.raises(WordError, match=r"^must be at least 0$"):
        read_quantity(-1, "1", least=0.0)
    with pytest.raises(WordError, match=r"^must be at most 1$"):
        read_quantity(1.5, "1", most=1.0)
