"""Quaternions by their algebra, against Rodrigues' formula and SciPy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from drawn import EPSILON, angles, apart, directions, fractions, rotations, vectors
from hypothesis import assume, given
from scipy.spatial.transform import Rotation, Slerp

from carom.ecs.column import Floats
from carom.ecs.spatial import constants, quaternion, vector
from carom.ecs.spatial.checks import GeometryError


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


@given(directions, angles)
def test_axis_and_angle_and_back(axis: Floats, angle: float) -> None:
    """The angle comes back within 0..pi, about the axis or its opposite, as SciPy's rotation vector has it."""
    q = quaternion.from_axis_angle(axis, angle)
    found, turn = quaternion.to_axis_angle(q)
    assert 0.0 <= turn <= math.pi
    assert vector.length(found) == pytest.approx(1.0, abs=EPSILON)
    assert apart(quaternion.from_axis_angle(found, turn), q) <= EPSILON
    assert turn == pytest.approx(Rotation.from_quat(q).magnitude(), abs=1e-7)


def test_nothing_turns_about_any_axis() -> None:
    """The identity, and its negative, get +x and 0."""
    axis, angle = quaternion.to_axis_angle([quaternion.IDENTITY, -quaternion.IDENTITY])
    assert axis.tolist() == [[1.0, 0.0, 0.0]] * 2
    assert angle.tolist() == [0.0, 0.0]


@given(rotations(), rotations())
def test_slerp_meets_its_ends(a: Floats, b: Floats) -> None:
    """It starts at a, ends at b (or -b, which is the same rotation), to the bit, and passes the middle of both."""
    assert quaternion.slerp(a, b, 0.0).tolist() == a.tolist()
    end = quaternion.slerp(a, b, 1.0)
    assert end.tolist() in (b.tolist(), (-b).tolist())
    assume(np.abs(a + end).max() > 1e-3)
    assert quaternion.slerp(a, b, 0.5) == pytest.approx(quaternion.normalise(a + end), abs=EPSILON)


@given(rotations(), rotations(), fractions)
def test_slerp_turns_at_constant_speed(a: Floats, b: Floats, t: float) -> None:
    """After the fraction t of the time the fraction t of the angle is done, and the quaternion is unit."""
    part = quaternion.slerp(a, b, t)
    assert quaternion.normalise(part) == pytest.approx(part, abs=EPSILON)
    _, whole = quaternion.to_axis_angle(quaternion.multiply(quaternion.conjugate(a), b))
    _, done = quaternion.to_axis_angle(quaternion.multiply(quaternion.conjugate(a), part))
    assert done == pytest.approx(t * whole, abs=10.0 * EPSILON)


def test_slerp_is_that_of_scipy() -> None:
    """Over 50 pairs, at times of their own."""
    generator = np.random.default_rng(2)
    a, b = quaternion.normalise(generator.normal(size=(2, 50, 4)))
    t = generator.uniform(size=50)
    found = quaternion.slerp(a, b, t)
    for k in range(50):
        assert apart(found[k], Slerp([0.0, 1.0], Rotation.from_quat([a[k], b[k]]))(t[k]).as_quat()) <= EPSILON


def test_slerp_where_both_ways_are_equally_short() -> None:
    """Half a turn apart it goes towards b as given; between q and -q, which is q, and between equals, it stays."""
    half = np.array([0.0, 1.0, 0.0, 0.0])
    root = math.sqrt(0.5)
    assert quaternion.slerp(constants.IDENTITY_ROTATION, half, 0.5) == pytest.approx([0.0, root, 0.0, root])
    assert quaternion.slerp(constants.IDENTITY_ROTATION, -half, 0.5) == pytest.approx([0.0, -root, 0.0, root])
    for other in (half, -half):
        assert quaternion.slerp(half, other, [0.0, 0.3, 1.0]).tolist() == [half.tolist()] * 3


def test_many_matrices_at_once() -> None:
    """From and to (..., 3, 3), each as if it were alone, and as SciPy has it."""
    q = quaternion.normalise(np.random.default_rng(3).normal(size=(5, 20, 4)))
    m = quaternion.matrix(q)
    assert m.reshape(-1, 3, 3) == pytest.approx(Rotation.from_quat(q.reshape(-1, 4)).as_matrix(), abs=EPSILON)
    back = quaternion.from_matrix(m)
    assert back.shape == (5, 20, 4)
    assert back[3, 4].tolist() == quaternion.from_matrix(m[3, 4]).tolist()
    assert np.minimum(np.abs(back - q).max(axis=-1), np.abs(back + q).max(axis=-1)).max() <= EPSILON


def test_arrays_of_axes_angles_and_sights() -> None:
    """Leading axes broadcast: one axis with many angles, many axes with one, each row as if it were alone."""
    generator = np.random.default_rng(4)
    axes, turns = generator.normal(size=(7, 3)), generator.normal(size=(5, 1))
    found = quaternion.from_axis_angle(axes, turns)
    assert found.shape == (5, 7, 4)
    assert found[2, 3].tolist() == quaternion.from_axis_angle(axes[3], float(turns[2, 0])).tolist()
    assert quaternion.from_axis_angle(axes[0], turns[:, 0]).shape == (5, 4)
    euler = generator.normal(size=(5, 7, 3))
    assert quaternion.from_euler(euler, "ZYX")[2, 3].tolist() == quaternion.from_euler(euler[2, 3], "ZYX").tolist()
    sights = quaternion.look_at(axes, euler)
    assert sights.shape == (5, 7, 4)
    assert sights[2, 3].tolist() == quaternion.look_at(axes[3], euler[2, 3]).tolist()


def test_an_up_of_any_length_counts() -> None:
    """Only its direction does: a tiny one is no parallel one, and a huge parallel one is."""
    level = quaternion.look_at((1.0, 0.0, -1.0), (0.0, 1.0, 1.0))
    assert quaternion.look_at((1.0, 0.0, -1.0), (0.0, 1e-12, 1e-12)) == pytest.approx(level, abs=EPSILON)
    assert quaternion.look_at((0.1, 0.2, 0.3), (1e12, 2e12, 3e12)) == pytest.approx(
        quaternion.look_at((0.1, 0.2, 0.3), constants.ZERO), abs=EPSILON
    )


@pytest.mark.parametrize("call", [quaternion.normalise, quaternion.to_axis_angle])
def test_a_zero_quaternion_is_no_rotation(call: object) -> None:
    """It is refused with its place."""
    with pytest.raises(GeometryError, match=r"is no rotation \(at index \[1\]\)$"):
        call([[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 0.0]])  # type: ignore[operator]


def test_what_has_no_direction_is_refused() -> None:
    """An axis and a sight of length 0."""
    with pytest.raises(GeometryError, match=r"^a zero vector has no direction$"):
        quaternion.from_axis_angle(constants.ZERO, 1.0)
    with pytest.raises(GeometryError, match=r"^a zero vector has no direction$"):
        quaternion.look_at(constants.ZERO)


def test_matrices_that_do_more_than_turn_are_refused() -> None:
    """Scale and mirror have no quaternion; digits typed by hand do."""
    with pytest.raises(GeometryError, match=r"columns are not orthonormal within 0.001 \(at index \[1\]\)$"):
        quaternion.from_matrix([np.eye(3), 2.0 * np.eye(3)])
    with pytest.raises(GeometryError, match=r"columns are left-handed, a mirror image$"):
        quaternion.from_matrix(np.diag([1.0, 1.0, -1.0]))
    with pytest.raises(GeometryError, match="not orthonormal"):
        quaternion.from_matrix(np.full((3, 3), math.nan))
    typed = quaternion.from_matrix([[0.707, 0.0, 0.707], [0.0, 1.0, 0.0], [-0.707, 0.0, 0.707]])
    assert typed == pytest.approx(quaternion.from_axis_angle(constants.UP, math.pi / 4), abs=1e-3)


@given(rotations(), vectors)
def test_change_of_handedness_follows_the_vectors(q: Floats, v: Floats) -> None:
    """To turn and to change is to change and to turn; twice is nothing."""
    changed = quaternion.change_handedness(q)
    assert quaternion.change_handedness(changed).tolist() == q.tolist()
    wanted = vector.change_handedness(quaternion.rotate(q, v))
    found = quaternion.rotate(changed, vector.change_handedness(v))
    assert np.abs(found - wanted).max() <= EPSILON * np.abs(v).max()
