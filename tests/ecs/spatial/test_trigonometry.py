"""Trigonometry to the last bits: of one number as kernels compile it, and of arrays."""

from __future__ import annotations

import math

import numpy as np
import pytest
from drawn import units_off
from hypothesis import given
from hypothesis import strategies as st

from carom.ecs.spatial.angles import arc_cosine, arc_sine, arc_tangent, sines_cosines
from carom.ecs.spatial.checks import GeometryError
from carom.ecs.spatial.trigonometry import exponential, sine_cosine

finite = st.floats(allow_nan=False, allow_infinity=False, allow_subnormal=False)


@given(st.floats(-1e6, 1e6))
def test_sine_and_cosine_are_right_to_two_units(angle: float) -> None:
    """Within 2 units in the last place of the C library, which is right to 1; next to a zero, of 1e-3.

    The reduced angle is known to 33 + 53 bits of pi/2, so next to a multiple of pi the relative error grows.
    """
    for found, true in zip(sine_cosine(angle), (math.sin(angle), math.cos(angle)), strict=True):
        assert abs(found - true) <= 2.0 * max(math.ulp(true), math.ulp(1e-3))


@given(st.floats(-0.78, 0.78))
def test_sine_and_cosine_of_small_angles(angle: float) -> None:
    """Where nothing is reduced, every value is right to 2 units of its own last place."""
    for found, true in zip(sine_cosine(angle), (math.sin(angle), math.cos(angle)), strict=True):
        assert units_off(found, true) <= 2.0


@given(st.floats(-700.0, 700.0))
def test_exponential_is_right_to_two_units(x: float) -> None:
    """Within 2 units in the last place of the C library."""
    assert units_off(exponential(x), math.exp(x)) <= 2.0


def test_the_ends_of_the_exponential() -> None:
    """It is exact at 0, vanishes far below it, and is held far above."""
    assert exponential(0.0) == 1.0
    assert exponential(-700.1) == 0.0
    assert exponential(1e6) == exponential(700.0)


@pytest.mark.parametrize(("angle", "sine", "cosine"), [(0.0, 0.0, 1.0), (math.pi / 6, 0.5, math.sqrt(0.75))])
def test_known_angles(angle: float, sine: float, cosine: float) -> None:
    """Zero is exact, 30 degrees within one unit."""
    s, c = sine_cosine(angle)
    assert units_off(s, sine) <= 1.0 if sine else s == 0.0
    assert units_off(c, cosine) <= 1.0


@given(st.lists(st.floats(-1e9, 1e9), max_size=9))
def test_arrays_of_angles_go_the_way_of_one(angles: list[float]) -> None:
    """Sines and cosines over arrays are those of kernels to the last bit, signs of zeros included."""
    sines, cosines = sines_cosines(angles)
    wanted = np.array([sine_cosine(angle) for angle in angles]).reshape(-1, 2)
    assert sines.tobytes() == wanted[:, 0].tobytes()
    assert cosines.tobytes() == wanted[:, 1].tobytes()


@given(finite, finite)
def test_arc_tangent_is_right_to_three_units(y: float, x: float) -> None:
    """Within 3 units in the last place of the C library, which is right to 1, in all four quadrants."""
    true = math.atan2(y, x or 0.0) if x or y else 0.0  # the sign of a zero x is not looked at
    found = float(arc_tangent(y, x))
    assert abs(found - true) <= 3.0 * max(math.ulp(true), 5e-324)
    assert abs(found) <= math.pi


@pytest.mark.parametrize("eighth", range(17))
def test_arc_tangent_across_the_knots(eighth: int) -> None:
    """Where one knot of the reduction hands over to the next nothing jumps."""
    for t in (eighth / 16, math.nextafter(eighth / 16, 2.0), math.nextafter(eighth / 16, -1.0)):
        true = math.atan(t)
        assert abs(float(arc_tangent(t)) - true) <= 3.0 * math.ulp(true)


@given(st.floats(-1.0, 1.0, allow_subnormal=False))
def test_arc_sine_and_arc_cosine_are_right_to_three_units(x: float) -> None:
    """Within 3 units in the last place of the C library."""
    assert abs(float(arc_sine(x)) - math.asin(x)) <= 3.0 * math.ulp(math.asin(x))
    assert abs(float(arc_cosine(x)) - math.acos(x)) <= 3.0 * math.ulp(math.acos(x))


def test_ends_of_the_arcs() -> None:
    """Right angles and half turns are the floats next to pi/2 and pi, and nothing is exactly nothing."""
    assert arc_tangent([0.0, 1.0, 0.0, -1.0, 0.0], [1.0, 0.0, -1.0, 0.0, 0.0]).tolist() == [
        0.0,
        math.pi / 2,
        math.pi,
        -math.pi / 2,
        0.0,
    ]
    assert arc_sine([-1.0, 0.0, 1.0]).tolist() == [-math.pi / 2, 0.0, math.pi / 2]
    assert arc_cosine([-1.0, 0.0, 1.0]).tolist() == [math.pi, math.pi / 2, 0.0]


def test_what_has_no_angle_is_refused() -> None:
    """Numbers off the ends of a function are named with their place, and never become a NaN."""
    with pytest.raises(GeometryError, match=r"^a sine is not within -1..1 \(at index \[1\]\)$"):
        arc_sine([0.0, 1.0000001])
    with pytest.raises(GeometryError, match=r"^a cosine is not within -1..1$"):
        arc_cosine(math.nan)
    with pytest.raises(GeometryError, match=r"^an arc tangent is asked of a number that is not finite$"):
        arc_tangent(math.inf, 1.0)
    with pytest.raises(GeometryError, match=r"^an angle is not within 1e\+09 rad \(at index \[0, 1\]\)$"):
        sines_cosines([[0.0, math.inf]])
