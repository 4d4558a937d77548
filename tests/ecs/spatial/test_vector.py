"""Vectors: products, lengths, parts, mirrors and what has no direction."""

from __future__ import annotations

import math

import numpy as np
import pytest
from drawn import EPSILON, directions, fractions, vectors
from hypothesis import given

from carom.ecs.column import Floats
from carom.ecs.spatial import constants, vector
from carom.ecs.spatial.checks import GeometryError


@given(vectors, vectors)
def test_products_are_those_of_numpy(a: Floats, b: Floats) -> None:
    """Dot and cross product against NumPy's, to a few roundings of the terms."""
    size = np.abs(a).max() * np.abs(b).max()
    assert abs(vector.dot(a, b) - np.dot(a, b)) <= EPSILON * size
    assert np.abs(vector.cross(a, b) - np.cross(a, b)).max() <= EPSILON * size
    assert vector.cross(a, b).tolist() == (-vector.cross(b, a)).tolist()


def test_the_frame_is_right_handed() -> None:
    """Right x up = back, and the short names are unit, opposite in pairs and read-only."""
    assert vector.cross(constants.RIGHT, constants.UP).tolist() == constants.BACK.tolist()
    for one, other in (("RIGHT", "LEFT"), ("UP", "DOWN"), ("FORWARD", "BACK")):
        assert (getattr(constants, one) + getattr(constants, other)).tolist() == constants.ZERO.tolist()
        assert vector.length(getattr(constants, one)) == 1.0
    with pytest.raises(ValueError, match="read-only"):
        constants.UP[0] = 1.0


@pytest.mark.parametrize("power", [-1060, -600, 0, 600, 1000])
def test_lengths_of_every_size(power: int) -> None:
    """The sides 3, 4 and 12 make 13 exactly, also where the squares would vanish or overflow."""
    v = np.ldexp([3.0, -4.0, 12.0], power)
    assert vector.length(v) == math.ldexp(13.0, power)
    assert vector.distance(v, -v) == math.ldexp(26.0, power)
    assert vector.normalise(v) == pytest.approx(np.array([3.0, -4.0, 12.0]) / 13.0, rel=EPSILON)


@given(directions)
def test_a_unit_vector_has_length_1_and_parts_within_1(v: Floats) -> None:
    """Divided by its length; the lecture has the parts between 0 and 1, but they run from -1."""
    unit = vector.normalise(v)
    assert vector.length(unit) == pytest.approx(1.0, abs=EPSILON)
    assert np.abs(unit).max() <= 1.0
    assert vector.normalise(-v).tolist() == (-unit).tolist()


def test_a_zero_vector_has_no_direction() -> None:
    """It is refused with its place, or replaced by what the caller names; so is one that is not finite."""
    pair = [[3.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    with pytest.raises(GeometryError, match=r"^a zero vector has no direction \(at index \[1\]\)$"):
        vector.normalise(pair)
    assert vector.normalise(pair, otherwise=constants.UP).tolist() == [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    for wrong in (math.nan, math.inf):
        with pytest.raises(GeometryError, match=r"^a vector is not finite$"):
            vector.normalise([wrong, 0.0, 0.0], otherwise=constants.UP)
    for function in (vector.project, vector.reject, vector.reflect, vector.angle):
        with pytest.raises(GeometryError, match=r"^a zero vector has no direction$"):
            function(constants.UP, constants.ZERO)


@given(vectors, vectors, fractions)
def test_lerp_meets_its_ends(a: Floats, b: Floats, t: float) -> None:
    """To the bit at 0 and 1, on a standing point everywhere, and on the line between."""
    assert vector.lerp(a, b, 0.0).tolist() == a.tolist()
    assert vector.lerp(a, b, 1.0).tolist() == b.tolist()
    assert vector.lerp(a, a, t).tolist() == a.tolist()
    wanted = (1.0 - t) * a + t * b
    assert np.abs(vector.lerp(a, b, t) - wanted).max() <= EPSILON * (np.abs(a).max() + np.abs(b).max())


@given(vectors, directions)
def test_projection_and_rejection_make_the_whole(v: Floats, onto: Floats) -> None:
    """One part lies along, the other across, and they add up."""
    along, across = vector.project(v, onto), vector.reject(v, onto)
    size = vector.length(v)
    assert np.abs(along + across - v).max() <= EPSILON * size
    assert vector.length(vector.cross(along, onto)) <= EPSILON * size * vector.length(onto)
    assert abs(vector.dot(across, onto)) <= EPSILON * size * vector.length(onto)


@given(vectors, directions)
def test_reflection_twice_is_identity(v: Floats, normal: Floats) -> None:
    """It keeps the length and turns the part along the normal round, for a normal of any length."""
    mirrored = vector.reflect(v, normal)
    size = vector.length(v)
    assert np.abs(vector.reflect(mirrored, normal) - v).max() <= EPSILON * size
    assert vector.length(mirrored) == pytest.approx(size, rel=EPSILON)
    assert abs(vector.dot(mirrored + v, normal)) <= EPSILON * size * vector.length(normal)


def test_walls_of_a_pool_table_turn_one_part_round() -> None:
    """The second lecture's trick for cushions east, west, north and south is reflection by their normals, exactly."""
    ball = [3.0, 0.0, -2.0]
    assert vector.reflect(ball, [constants.LEFT, constants.FORWARD]).tolist() == [[-3.0, 0.0, -2.0], [3.0, 0.0, 2.0]]


@pytest.mark.parametrize("turn", [0.0, 1e-9, 0.1, math.pi / 2, 3.0, math.pi - 1e-9, math.pi])
def test_angles_keep_their_digits(turn: float) -> None:
    """Next to 0 and a half turn too, where an arc cosine would lose half of them."""
    found = vector.angle([5.0, 0.0, 0.0], [0.2 * math.cos(turn), 0.2 * math.sin(turn), 0.0])
    assert found == pytest.approx(turn, rel=EPSILON, abs=1e-15)


def test_everything_works_over_arrays() -> None:
    """Leading axes broadcast as NumPy has it."""
    generator = np.random.default_rng(0)
    many, few = generator.normal(size=(5, 7, 3)), generator.normal(size=(7, 3))
    for function in (vector.cross, vector.project, vector.reject, vector.reflect):
        assert function(many, few).shape == (5, 7, 3)
        assert function(many, few)[2, 3].tolist() == function(many[2, 3], few[3]).tolist()
    for function in (vector.dot, vector.distance, vector.angle):
        assert function(many, few).shape == (5, 7)
        assert function(few, many)[2, 3] == function(few[3], many[2, 3])
    assert vector.lerp(many, few, np.zeros((2, 1, 1))).shape == (2, 5, 7, 3)
    assert vector.normalise(np.zeros((0, 3))).shape == (0, 3)


def test_other_shapes_are_refused() -> None:
    """A pair or a quaternion is no vector."""
    with pytest.raises(GeometryError, match=r"^a vector has shape \(4,\); accepted: \(..., 3\)$"):
        vector.length([1.0, 2.0, 3.0, 4.0])
    with pytest.raises(GeometryError, match=r"^a vector has shape \(\); accepted: \(..., 3\)$"):
        vector.dot(1.0, constants.UP)


@given(vectors, vectors)
def test_change_of_handedness_twice_is_identity(a: Floats, b: Floats) -> None:
    """Distances stay, and a cross product comes out the other way round."""
    assert vector.change_handedness(vector.change_handedness(a)).tolist() == a.tolist()
    left_a, left_b = vector.change_handedness(a), vector.change_handedness(b)
    assert vector.distance(left_a, left_b) == vector.distance(a, b)
    assert vector.cross(left_a, left_b).tolist() == (-vector.change_handedness(vector.cross(a, b))).tolist()
