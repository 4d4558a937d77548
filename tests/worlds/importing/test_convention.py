"""Axes, handedness and units change without a bit of rounding, and nothing is turned inside out."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from carom.ecs.spatial import quaternion
from carom.worlds.importing.convention import Convention
from carom.worlds.importing.model import Pose

NUMBERS = st.floats(-10, 10, allow_nan=False)
VECTORS = st.tuples(NUMBERS, NUMBERS, NUMBERS).map(np.array)
TURNS = (
    st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS).map(np.array).filter(lambda q: q @ q > 0.01).map(quaternion.normalise)
)
POSES = st.builds(Pose, VECTORS, TURNS)
CONVENTIONS = st.builds(Convention, st.sampled_from("xyz"), st.sampled_from(["right", "left"]))


@given(POSES, VECTORS)
def test_mirrored_twice_everything_is_as_it_was(pose: Pose, axis: np.ndarray) -> None:
    """To the last bit: poses, axes and tensors."""
    mirror = Convention("y", "left")
    back = mirror.pose(mirror.pose(pose))
    assert np.array_equal(back.position, pose.position) and np.array_equal(back.rotation, pose.rotation)
    assert np.array_equal(mirror.axis(mirror.axis(axis)), axis)
    tensor = np.multiply.outer(axis, pose.position)
    assert np.array_equal(mirror.tensor(mirror.tensor(tensor)), tensor)


@given(CONVENTIONS, VECTORS, TURNS)
def test_positions_and_rotations_only_change_places_and_signs(way: Convention, p: np.ndarray, q: np.ndarray) -> None:
    """So nothing is rounded, and quaternions stay unit."""
    assert sorted(np.abs(way.point(p))) == sorted(np.abs(p))
    assert sorted(np.abs(way.rotation(q))) == sorted(np.abs(q))


@given(CONVENTIONS, POSES, POSES, VECTORS)
def test_what_is_in_a_frame_stays_in_it(way: Convention, outer: Pose, inner: Pose, point: np.ndarray) -> None:
    """Poses may be put together before or after, and points placed before or after."""
    before, after = way.pose(outer.then(inner)), way.pose(outer).then(way.pose(inner))
    assert before.position == pytest.approx(after.position, abs=1e-12)
    assert before.rotation == pytest.approx(after.rotation, abs=1e-12)
    assert way.point(outer.point(point)) == pytest.approx(way.pose(outer).point(way.point(point)), abs=1e-12)


@given(CONVENTIONS, VECTORS.filter(lambda v: v @ v > 0.01), NUMBERS, VECTORS)
def test_a_turn_about_an_axis_is_the_same_turn(way: Convention, axis: np.ndarray, angle: float, p: np.ndarray) -> None:
    """A joint that stands at an angle takes what it holds to the same place."""
    there = quaternion.rotate(quaternion.from_axis_angle(axis, angle), p)
    here = quaternion.rotate(quaternion.from_axis_angle(way.axis(axis), angle), way.point(p))
    assert way.point(there) == pytest.approx(here, abs=1e-12)


@given(CONVENTIONS, VECTORS, TURNS)
def test_tensors_turn_with_what_they_are_of(way: Convention, spin: np.ndarray, q: np.ndarray) -> None:
    """The kinetic energy of a body that spins is the same there and here."""
    axes = quaternion.matrix(q)
    tensor = axes @ np.diag([1.0, 2.0, 4.0]) @ axes.T
    turned = way.axis(spin)
    assert turned @ way.tensor(tensor) @ turned == pytest.approx(spin @ tensor @ spin, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("up", "xyz")
def test_hands_and_up(up: str) -> None:
    """Up becomes y; three fingers of a right hand stay such, those of a left hand become such of a right one."""
    for hand, turn in (("right", 1.0), ("left", -1.0)):
        way = Convention(up, hand)
        assert way.direction(np.eye(3)["xyz".index(up)]).tolist() == [0, 1, 0]
        thumb, index, middle = (way.direction(axis) for axis in np.eye(3))
        assert np.cross(thumb, index) @ middle == turn


def test_units_are_lengths() -> None:
    """A cm is 0.01 m, and an inertia in kg cm2 is 1e-4 kg m2."""
    way = Convention("y", "right", 0.01)
    assert way.point((1.0, 2.0, 3.0)) == pytest.approx([0.01, 0.02, 0.03], rel=1e-15)
    assert way.tensor(np.eye(3)) == pytest.approx(1e-4 * np.eye(3), rel=1e-15)
    assert way.axis((0.0, 0.0, 1.0)).tolist() == [0, 0, 1]
