"""Contacts of fast pairs that were too far to be trusted are followed, until their planes come near."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np
import pytest

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.constants import MEET
from carom.systems.kernels.fast_pairs import NEVER
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.left_out import when_near, write_left_out
from carom.systems.looked import LeftOut

TRUST, GAP, WAY = 0.04, 0.1, 0.1 - 0.5 * MEET * 0.04  # m; to well within what is near
STANDS, UP, STILL = np.array([0.0, 0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0]), np.zeros(3)


@kernel()
def when(span, bodies, normals, gaps, nears, places, center, rotation, linear, angular):
    """Return when the first is near."""
    return when_near(span, bodies, normals, gaps, nears, places, center, rotation, linear, angular)


def left_out(rotation: Floats = STANDS) -> LeftOut:
    """Return the second of three contacts: of a corner of body 0 a metre off, at (1, 0, 0), and what stands beneath."""
    out, center = LeftOut.room(1), np.zeros((1, 3))
    write_left_out(
        np.array([[0, 2], [1, 3]]), np.array([[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, TRUST]]),
        np.array([False, True, False]), np.array([0, 1, 4]), np.array([2, 3, 5]),
        np.array([UP, -UP, UP]), np.array([0.0, -GAP, 0.0]), np.array([UP, [1.0, 0.0, 0.0], UP]),
        np.array([-1, 0, -1, -1, -1, -1]), center, rotation[None], *out,
    )  # fmt: skip
    return out


def near(
    span: float = 1.0, *, center: Floats = STILL, rotation: Floats = STANDS, linear: Floats = STILL,
    angular: Floats = STILL, found: Floats = STANDS,
) -> float:  # fmt: skip
    """Return when the contact is near."""
    return float(when(span, *left_out(found), center[None], rotation[None], linear[None], angular[None]))


def test_who_comes_straight_on_is_near_when_the_gap_is_closed_but_for_a_little() -> None:
    """Not beyond the time that is asked for; who goes away never is."""
    assert near(linear=-2.0 * UP) == pytest.approx(WAY / 2.0, rel=1e-12)
    assert near(WAY / 2.0 * 0.999, linear=-2.0 * UP) == NEVER
    assert near(linear=2.0 * UP) == near() == NEVER


def test_turning_counts_at_the_corner() -> None:
    """It is a metre off."""
    assert near(angular=np.array([0.0, 0.0, -2.0])) == pytest.approx(WAY / 2.0, rel=1e-12)


@pytest.mark.parametrize("found", [STANDS, quaternion.from_axis_angle((1.0, 2.0, 3.0), 1.0)])
def test_the_corner_goes_with_its_body(found: Floats) -> None:
    """From however that was turned when it was found: down by 0.02 m and by what a turn of 0.03 takes it."""
    turn = quaternion.multiply(quaternion.from_axis_angle((0.0, 0.0, 1.0), -0.03), found)
    way = WAY - 0.02 - np.sin(0.03)
    assert near(center=-0.02 * UP, rotation=turn, linear=-UP, found=found) == pytest.approx(way, rel=1e-12)


def test_who_is_near_and_comes_nearer_is_to_be_looked_at_now() -> None:
    """Also who has come beyond; but not who goes away."""
    for gap in (0.99 * MEET * TRUST, -0.01):
        assert near(center=(gap - GAP) * UP, linear=-UP) == 0.0
        assert near(center=(gap - GAP) * UP, linear=UP) == NEVER
    assert near(center=(1.01 * MEET * TRUST - GAP) * UP, linear=-UP) > 0.0
