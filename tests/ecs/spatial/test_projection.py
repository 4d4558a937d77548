"""Cameras: what they look at is ahead of them, and what they see fills -1..1."""

from __future__ import annotations

import math

import numpy as np
import pytest
from drawn import EPSILON, directions, vectors
from hypothesis import assume, given
from hypothesis import strategies as st

from carom.ecs.column import Floats
from carom.ecs.spatial import constants, matrix, projection, vector
from carom.ecs.spatial.checks import GeometryError

nears = st.floats(0.01, 1.0)
depths = st.floats(0.1, 1000.0)


@given(vectors, directions)
def test_a_camera_looks_at_its_target(eye: Floats, sight: Floats) -> None:
    """The target is straight ahead at its distance, the eye at the origin, and up is upward in the picture."""
    view = projection.view(eye, eye + sight)
    far = vector.distance(eye, eye + sight)
    size = 1e-13 * (1.0 + np.abs(eye).max() + far)
    assert np.abs(matrix.transform_points(view, eye + sight) - far * constants.FORWARD).max() <= size
    assert np.abs(matrix.transform_points(view, eye)).max() <= size
    assume(abs(vector.normalise(sight)[1]) < 0.999)
    up = matrix.transform_directions(view, constants.UP)
    assert abs(up[0]) <= 1e-12
    assert up[1] > 0.0


def test_a_camera_that_looks_straight_down_still_sees() -> None:
    """Up along the line of sight says nothing; the picture is turned as ``quaternion.look_at`` has it."""
    view = projection.view((0.0, 5.0, 0.0), constants.ZERO)
    assert matrix.transform_points(view, constants.ZERO) == pytest.approx([0.0, 0.0, -5.0], abs=EPSILON)
    assert matrix.determinant(view) == pytest.approx(1.0, abs=EPSILON)
    with pytest.raises(GeometryError, match=r"^a camera stands where it looks \(at index \[1\]\)$"):
        projection.view([constants.ZERO, constants.ONE], constants.ONE)


@given(st.floats(0.1, 3.0), st.floats(0.2, 5.0), nears, depths)
def test_a_pinhole_s_corners_are_corners_of_the_picture(fov: float, aspect: float, near: float, depth: float) -> None:
    """The plane at near goes to -1, at far to +1, and the edges of the angle of view to the edges of the picture."""
    far = near + depth
    lens = projection.perspective(fov, aspect, near, far)
    for distance, z in ((near, -1.0), (far, 1.0)):
        high = distance * math.tan(fov / 2.0)
        found = matrix.transform_points(lens, [[-aspect * high, -high, -distance], [aspect * high, high, -distance]])
        wanted = np.array([[-1.0, -1.0, z], [1.0, 1.0, z]])
        # The depth is a difference of numbers of the size far / depth.
        assert np.abs(found - wanted).max() <= 10.0 * EPSILON * (1.0 + far / depth)


@given(nears, depths)
def test_a_pinhole_keeps_what_is_in_front_in_front(near: float, depth: float) -> None:
    """Depth rises away from the eye."""
    lens = projection.perspective(1.0, 1.0, near, near + depth)
    points = constants.FORWARD * np.linspace(near, near + depth, 9)[:, None]
    assert (np.diff(matrix.transform_points(lens, points)[:, 2]) > 0.0).all()


@given(vectors, directions.map(lambda v: 1.0 + np.abs(v)))
def test_parallel_light_fills_its_box(low: Floats, size: Floats) -> None:
    """The corners of the box, near and far along -z, are the corners -1..1; the volume goes with it."""
    left, bottom, near = low
    right, top, far = low + size
    lens = projection.orthographic(left, right, bottom, top, near, far)
    found = matrix.transform_points(lens, [[left, bottom, -near], [right, top, -far]])
    assert np.abs(found - [[-1.0] * 3, [1.0] * 3]).max() <= 1e-12 * (1.0 + np.abs(low).max())
    assert matrix.determinant(lens) == pytest.approx(-8.0 / np.prod(size), rel=1e-9)


def test_a_picture_for_a_left_handed_renderer() -> None:
    """Point, camera and lens changed to the other hand make the same picture: P F sees what P sees, from +z."""
    eye, target, point = np.array([1.0, 2.0, 3.0]), np.array([0.0, 1.0, 0.0]), np.array([0.5, 0.5, -0.5])
    view, lens = projection.view(eye, target), projection.perspective(1.0, 1.5, 0.1, 100.0)
    wanted = matrix.transform_points(lens, matrix.transform_points(view, point))
    seen = matrix.transform_points(matrix.change_handedness(view), vector.change_handedness(point))
    assert seen[2] > 0.0
    found = matrix.transform_points(matrix.product(lens, constants.LEFT_FROM_RIGHT), seen)
    assert found == pytest.approx(wanted, abs=EPSILON)


def test_lenses_over_arrays() -> None:
    """Many angles of view with one of all else."""
    lenses = projection.perspective(np.linspace(0.5, 1.5, 4), 1.0, 0.1, np.full((3, 1), 10.0))
    assert lenses.shape == (3, 4, 4, 4)
    assert lenses[1, 2].tolist() == projection.perspective(np.linspace(0.5, 1.5, 4)[2], 1.0, 0.1, 10.0).tolist()
    assert projection.orthographic(-1, 1, -1, 1, 0, np.ones(5)).shape == (5, 4, 4)
    assert projection.view(np.ones((6, 1, 3)), np.zeros((2, 3))).shape == (6, 2, 4, 4)


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ((0.0, 1.0, 0.1, 1.0), "an angle of view is not between 0 and pi"),
        ((math.pi, 1.0, 0.1, 1.0), "an angle of view is not between 0 and pi"),
        ((1.0, 0.0, 0.1, 1.0), "an aspect is not above 0"),
        ((1.0, 1.0, 0.0, 1.0), "planes are not in the order 0 < near < far"),
        ((1.0, 1.0, 1.0, 1.0), "planes are not in the order 0 < near < far"),
        ((1.0, 1.0, 1.0, math.inf), "planes are not in the order 0 < near < far"),
    ],
)
def test_lenses_that_show_nothing_are_refused(numbers: tuple[float, ...], message: str) -> None:
    """Whole messages."""
    with pytest.raises(GeometryError, match=f"^{message}$"):
        projection.perspective(*numbers)


@pytest.mark.parametrize(("axis", "name"), [(0, "width"), (1, "height"), (2, "depth")])
def test_boxes_without_room_are_refused(axis: int, name: str) -> None:
    """On each axis."""
    sides = [-1.0, 1.0] * 3
    sides[2 * axis] = 1.0
    with pytest.raises(GeometryError, match=f"^a box has no {name}$"):
        projection.orthographic(*sides)
