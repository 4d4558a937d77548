"""Trigonometry to the last bits, and quaternions by their algebra."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.ecs.spatial.trigonometry import exponential, sine_cosine

EPSILON = 1e-14  # a few roundings of numbers near 1

components = st.floats(-1.0, 1.0)
vectors = st.tuples(*[st.integers(-(10**9), 10**9)] * 3).map(lambda v: np.array(v) * 1e-6)
directions = vectors.filter(lambda v: float(v @ v) > 1e-4)
angles = st.floats(-10.0, 10.0)


@st.composite
def rotations(draw: st.DrawFn) -> Floats:
    """Draw a unit quaternion."""
    q = np.array(draw(st.tuples(*[components] * 4)))
    assume(q @ q > 1e-4)
    return quaternion.normalise(q)


def units_off(found: float, true: float) -> float:
    """Return how many units in the last place of ``true`` a number is off."""
    return abs(found - true) / math.ulp(true)


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


@given(rotations(), vectors)
def test_rotation_preserves_length_and_is_undone_by_its_conjugate(q: Floats, v: Floats) -> None:
    """To a few roundings of the vector's length."""
    size = np.linalg.norm(v)
    turned = quaternion.rotate(q, v)
    assert np.linalg.norm(turned) == pytest.approx(size, rel=EPSILON, abs=1e-300)
    assert np.abs(quaternion.rotate(quaternion.conjugate(q), turned) - v).max() <= EPSILON * size


@given(rotations(), rotations(), vectors)
def test_a_product_turns_by_one_after_the_other(a: Floats, b: Floats, v: Floats) -> None:
    """``multiply(a, b)`` is b followed by a."""
    together, apart = quaternion.rotate(quaternion.multiply(a, b), v), quaternion.rotate(a, quaternion.rotate(b, v))
    assert np.abs(together - apart).max() <= 2.0 * EPSILON * np.linalg.norm(v)


@given(rotations())
def test_matrix_and_back(q: Floats) -> None:
    """The matrix is a rotation with the turned axes as columns, and leads back to the quaternion or its negative."""
    m = quaternion.matrix(q)
    assert np.abs(m @ m.T - np.eye(3)).max() <= EPSILON
    assert np.linalg.det(m) == pytest.approx(1.0, rel=EPSILON)
    assert m[:, 1] == pytest.approx(quaternion.rotate(q, (0.0, 1.0, 0.0)), abs=EPSILON)
    back = quaternion.from_matrix(m)
    assert np.abs(back * np.sign(back @ q) - q).max() <= EPSILON


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_half_turn_survives_the_matrix(axis: int) -> None:
    """Where w vanishes, the other branches of the conversion take over."""
    q = np.eye(4)[axis]
    back = quaternion.from_matrix(quaternion.matrix(q))
    assert np.abs(back) == pytest.approx(q, abs=EPSILON)


@given(directions, angles, vectors)
def test_axis_and_angle_turn_as_rodrigues_says(axis: Floats, angle: float, v: Floats) -> None:
    """The vector v becomes v cos t + (k x v) sin t + k (k.v)(1 - cos t) for any length of the axis."""
    k = axis / np.linalg.norm(axis)
    sine, cosine = math.sin(angle), math.cos(angle)
    wanted = v * cosine + np.cross(k, v) * sine + k * (k @ v) * (1.0 - cosine)
    found = quaternion.rotate(quaternion.from_axis_angle(axis, angle), v)
    assert np.abs(found - wanted).max() <= 10.0 * EPSILON * np.linalg.norm(v)


@given(directions)
def test_look_at_turns_forward_to_the_direction(direction: Floats) -> None:
    """-z points along it; x stays level and y upward, unless it looks straight up or down."""
    unit = direction / np.linalg.norm(direction)
    turn = quaternion.matrix(quaternion.look_at(direction))
    assert -turn[:, 2] == pytest.approx(unit, abs=1e-13)
    if abs(unit[1]) < 0.999:
        assert turn[1, 0] == pytest.approx(0.0, abs=1e-12)
        assert turn[1, 1] > 0.0


@pytest.mark.parametrize("direction", [(0.0, 1.0, 0.0), (0.0, -2.0, 0.0)])
def test_look_at_straight_up_and_down(direction: tuple[float, float, float]) -> None:
    """Where up is along the direction there is still a rotation."""
    turn = quaternion.matrix(quaternion.look_at(direction))
    assert -turn[:, 2] == pytest.approx(np.array(direction) / np.linalg.norm(direction), abs=EPSILON)
    assert np.linalg.det(turn) == pytest.approx(1.0, abs=EPSILON)


ORDERS = ["".join(axes) for axes in product("xyz", repeat=3) if axes[0] != axes[1] != axes[2]]


@pytest.mark.parametrize("order", [*ORDERS, *(order.upper() for order in ORDERS)])
def test_euler_angles_in_every_order(order: str) -> None:
    """Lower case turns about fixed axes, upper case about the turning ones, as scipy has it."""
    from scipy.spatial.transform import Rotation

    turns = np.array([0.3, -1.1, 2.5])
    wanted = Rotation.from_euler(order, turns).as_quat()
    found = quaternion.from_euler(turns, order)
    assert np.abs(found * np.sign(found @ wanted) - wanted).max() <= EPSILON
    reverse = order[::-1].swapcase()
    other = quaternion.from_euler(turns[::-1], reverse)
    assert np.abs(other * np.sign(other @ wanted) - wanted).max() <= EPSILON


def test_everything_works_over_arrays() -> None:
    """Leading axes broadcast: one rotation of many vectors, many of one, and many of many."""
    generator = np.random.default_rng(0)
    q, v = quaternion.normalise(generator.normal(size=(7, 4))), generator.normal(size=(7, 3))
    each = np.array([quaternion.rotate(a, b) for a, b in zip(q, v, strict=True)])
    assert quaternion.rotate(q, v).tolist() == each.tolist()
    assert quaternion.rotate(q[0], v)[3].tolist() == quaternion.rotate(q[0], v[3]).tolist()
    assert quaternion.rotate(q, v[0])[3].tolist() == quaternion.rotate(q[3], v[0]).tolist()
    assert quaternion.matrix(q).shape == (7, 3, 3)
    assert quaternion.multiply(q, q[0]).shape == (7, 4)
