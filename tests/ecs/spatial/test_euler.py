"""Euler angles in every order, to and fro, and at the gimbal lock."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from drawn import EPSILON, apart, rotations
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.ecs.spatial.checks import GeometryError

ORDERS = ["".join(axes) for axes in product("xyz", repeat=3) if axes[0] != axes[1] != axes[2]]


@pytest.mark.parametrize("order", [*ORDERS, *(order.upper() for order in ORDERS)])
def test_euler_angles_in_every_order(order: str) -> None:
    """Lower case turns about fixed axes, upper case about the turning ones, as scipy has it."""
    turns = np.array([0.3, -1.1, 2.5])
    wanted = Rotation.from_euler(order, turns).as_quat()
    found = quaternion.from_euler(turns, order)
    assert np.abs(found * np.sign(found @ wanted) - wanted).max() <= EPSILON
    reverse = order[::-1].swapcase()
    other = quaternion.from_euler(turns[::-1], reverse)
    assert np.abs(other * np.sign(other @ wanted) - wanted).max() <= EPSILON


TURNS = [*ORDERS, *(order.upper() for order in ORDERS)]
outer = st.floats(-3.14, 3.14)


@pytest.mark.parametrize("order", TURNS)
@settings(max_examples=30)
@given(outer, st.floats(-1.55, 1.55), outer)
def test_angles_come_back(order: str, first: float, middle: float, third: float) -> None:
    """Away from the lock the angles themselves; two-axis orders have their middle within 0..pi."""
    turns = np.array([first, middle + (math.pi / 2 if order[0] == order[2] else 0.0), third])
    found = quaternion.to_euler(quaternion.from_euler(turns, order), order)
    assert np.abs(found - turns).max() <= 1e-12  # 1e-15 over the cosine of 1.55


@pytest.mark.parametrize("order", TURNS)
def test_angles_of_scipy(order: str) -> None:
    """100 rotations at once, as SciPy has them."""
    q = quaternion.normalise(np.random.default_rng(1).normal(size=(100, 4)))
    assert quaternion.to_euler(q, order) == pytest.approx(Rotation.from_quat(q).as_euler(order), abs=1e-12)


@pytest.mark.parametrize("order", TURNS)
@settings(max_examples=30)
@given(outer, outer, st.booleans())
def test_at_the_lock_the_rotation_comes_back(order: str, first: float, third: float, high: bool) -> None:
    """Only the rotation is known there: the third angle is 0 and the first takes both."""
    low_end, high_end = (0.0, math.pi) if order[0] == order[2] else (-math.pi / 2, math.pi / 2)
    middle = high_end if high else low_end
    q = quaternion.from_euler([first, middle, third], order)
    found = quaternion.to_euler(q, order)
    assert found[2] == 0.0
    assert found[1] == pytest.approx(middle, abs=1e-9)
    assert np.abs(found).max() <= math.pi
    assert apart(quaternion.from_euler(found, order), q) <= EPSILON


@pytest.mark.parametrize("order", TURNS)
@settings(max_examples=20)
@given(rotations(), st.floats(1e-16, 1e-5))
def test_next_to_the_lock_the_rotation_comes_back(order: str, q: Floats, off: float) -> None:
    """However near: what the outer angles lose to rounding they lose against each other."""
    turns = quaternion.to_euler(q, order)
    turns[1] = off if order[0] == order[2] else math.pi / 2 - off
    near = quaternion.from_euler(turns, order)
    assert apart(quaternion.from_euler(quaternion.to_euler(near, order), order), near) <= 1e-9


def test_an_order_may_have_any_number_of_axes() -> None:
    """One turn, or five, are as good as three on the way in."""
    assert quaternion.from_euler([0.4], "y").tolist() == quaternion.from_axis_angle((0.0, 1.0, 0.0), 0.4).tolist()
    assert apart(quaternion.from_euler([0.1, 0.2, 0.3, 0.4, 0.5], "XXXXX"), quaternion.from_euler([1.5], "X")) < EPSILON


@pytest.mark.parametrize("order", ["", "xYz", "abc"])
def test_what_is_no_order_is_refused(order: str) -> None:
    """Whole messages, both ways."""
    message = f"^'{order}' is no order of axes; accepted: X, Y, Z for the turning axes, or x, y, z for fixed ones$"
    for call in (quaternion.from_euler, quaternion.to_euler):
        with pytest.raises(GeometryError, match=message):
            call([0.0, 0.0, 0.0, 1.0], order)


def test_orders_that_leave_angles_open_are_refused() -> None:
    """Three angles need three axes, no two neighbours alike; an order needs as many angles as it has axes."""
    for order in ("xy", "xxy", "XYY", "xyzx"):
        message = f"^'{order}' leaves angles open; accepted: three axes, no two neighbours alike$"
        with pytest.raises(GeometryError, match=message):
            quaternion.to_euler(quaternion.IDENTITY, order)
    with pytest.raises(GeometryError, match=r"^angles in the order 'xyz' has shape \(2,\); accepted: \(..., 3\)$"):
        quaternion.from_euler([0.0, 1.0], "xyz")
    with pytest.raises(GeometryError, match=r"^a zero quaternion is no rotation$"):
        quaternion.to_euler(np.zeros(4), "xyz")
