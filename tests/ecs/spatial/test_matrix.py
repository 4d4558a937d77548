"""Matrices: the lecture's examples, and the algebra against NumPy's."""

from __future__ import annotations

import math

import numpy as np
import pytest
from drawn import EPSILON, directions, rotations, vectors
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from carom.ecs.column import Floats
from carom.ecs.spatial import affine, constants, matrix, projection, vector
from carom.ecs.spatial.checks import GeometryError

matrices = arrays(np.float64, (4, 4), elements=st.integers(-1000, 1000).map(lambda n: n / 100.0))
DOWN_BY_TWO = (0.0, -2.0, 0.0)


def test_a_point_and_a_direction_through_the_lecture_s_translation() -> None:
    """(0, 1, 0) moved down the y axis by 2 is (0, -1, 0); the same on a direction does nothing."""
    down = affine.translation(DOWN_BY_TWO)
    assert matrix.transform_points(down, (0.0, 1.0, 0.0)).tolist() == [0.0, -1.0, 0.0]
    assert matrix.transform_directions(down, (0.0, 1.0, 0.0)).tolist() == [0.0, 1.0, 0.0]


def test_the_lecture_s_row_vector_and_matrix() -> None:
    """(0 1 0 1) times the matrix as printed, with -2 in the last row, is (0 -1 0 1): our matrix, transposed."""
    printed = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, -2, 0, 1]]
    assert matrix.transpose(affine.translation(DOWN_BY_TWO)).tolist() == printed
    assert matrix.product([[0, 1, 0, 1]], printed).tolist() == [[0, -1, 0, 1]]
    assert matrix.product(matrix.transpose(printed), [[0], [1], [0], [1]]).tolist() == [[0], [-1], [0], [1]]


def test_sizes_of_products_in_the_lecture() -> None:
    """4x4 times 4x4 is 4x4; 1x2 times 2x2 is 1x2."""
    assert matrix.product(np.eye(4), np.eye(4)).tolist() == np.eye(4).tolist()
    assert matrix.product([[1, 2]], [[3, 4], [5, 6]]).tolist() == [[13, 16]]


def test_sizes_that_do_not_pair_are_refused() -> None:
    """The columns of one must be as many as the rows of the other."""
    message = r"^matrices have shapes \(2, 2\) and \(1, 2\); accepted: \(..., m, n\) and \(..., n, p\)$"
    with pytest.raises(GeometryError, match=message):
        matrix.product(np.ones((2, 2)), [[1, 2]])
    with pytest.raises(GeometryError, match=r"^matrices have shapes \(4, 4\) and \(4,\)"):
        matrix.product(np.eye(4), np.ones(4))
    with pytest.raises(GeometryError, match=r"^a matrix has shape \(3,\); accepted: \(..., m, n\)$"):
        matrix.transpose([1, 2, 3])
    with pytest.raises(GeometryError, match=r"^a matrix has shape \(3, 3\); accepted: \(..., 4, 4\)$"):
        matrix.determinant(np.eye(3))


@given(matrices, matrices)
def test_products_and_determinants(a: Floats, b: Floats) -> None:
    """Against NumPy; the determinant of a product is the product of the determinants."""
    together = matrix.product(a, b)
    assert together == pytest.approx(a @ b, abs=1e-11)
    assert matrix.determinant(a) == pytest.approx(np.linalg.det(a), abs=1e-7)
    assert matrix.determinant(together) == pytest.approx(matrix.determinant(a) * matrix.determinant(b), abs=1e-2)
    assert matrix.transpose(together).tolist() == matrix.product(matrix.transpose(b), matrix.transpose(a)).tolist()


@given(matrices)
def test_the_inverse_undoes_from_both_sides(m: Floats) -> None:
    """To roundings of the condition of the matrix."""
    assume(abs(matrix.determinant(m)) > 1e-6)
    condition = np.linalg.cond(m)
    assume(condition < 1e6)
    back = matrix.inverse(m)
    for both in (matrix.product(back, m), matrix.product(m, back)):
        assert np.abs(both - np.eye(4)).max() <= 1e-13 * condition**2
    assert matrix.determinant(back) * matrix.determinant(m) == pytest.approx(1.0, rel=1e-13 * condition**2)


def test_a_matrix_without_inverse_is_refused() -> None:
    """With its place; so is one that is not finite."""
    flat = np.diag([1.0, 0.0, 1.0, 1.0])
    message = r"^a matrix has no inverse: its determinant is 0 or not finite \(at index \[1\]\)$"
    with pytest.raises(GeometryError, match=message):
        matrix.inverse([np.eye(4), flat])
    with pytest.raises(GeometryError, match=r"not finite$"):
        matrix.inverse(np.full((4, 4), math.nan))


@given(rotations(), vectors, vectors, directions)
def test_points_move_and_directions_do_not(q: Floats, offset: Floats, point: Floats, direction: Floats) -> None:
    """A difference of points is a direction, and goes its way."""
    m = affine.compose(offset, q)
    size = 10.0 * (np.abs(offset).max() + np.abs(point).max() + np.abs(direction).max())
    moved = matrix.transform_points(m, point + direction) - matrix.transform_points(m, point)
    assert np.abs(moved - matrix.transform_directions(m, direction)).max() <= EPSILON * size
    assert vector.length(matrix.transform_directions(m, direction)) == pytest.approx(
        vector.length(direction), rel=1e-13
    )


def test_a_point_beside_the_eye_has_no_image() -> None:
    """In the plane through the eye w is 0, and there is nothing to divide by."""
    lens = projection.perspective(1.0, 1.0, 0.1, 10.0)
    with pytest.raises(
        GeometryError, match=r"^a point has no image: it lies in the plane of the eye \(at index \[1\]\)$"
    ):
        matrix.transform_points(lens, [constants.FORWARD, constants.RIGHT])


@given(rotations(), vectors, vectors)
def test_change_of_handedness_is_an_involution(q: Floats, offset: Floats, point: Floats) -> None:
    """The basis changes with determinant -1; what is done in it keeps its own, and follows the points."""
    m = affine.compose(offset, q, scale=(1.0, 2.0, 3.0))
    changed = matrix.change_handedness(m)
    basis = constants.LEFT_FROM_RIGHT
    assert matrix.determinant(basis) == -1.0
    assert matrix.product(basis, basis).tolist() == np.eye(4).tolist()
    assert matrix.change_handedness(changed).tolist() == m.tolist()
    assert changed.tolist() == matrix.product(matrix.product(basis, m), basis).tolist()
    assert matrix.determinant(changed) == pytest.approx(6.0, rel=1e-13)
    wanted = vector.change_handedness(matrix.transform_points(m, point))
    assert matrix.transform_points(changed, vector.change_handedness(point)).tolist() == wanted.tolist()


def test_everything_works_over_arrays() -> None:
    """Leading axes broadcast: one matrix on many points, many on one, and many on many."""
    generator = np.random.default_rng(0)
    many, few = generator.normal(size=(5, 7, 4, 4)), generator.normal(size=(7, 4, 4))
    points = generator.normal(size=(7, 3))
    assert matrix.product(many, few)[2, 3].tolist() == matrix.product(many[2, 3], few[3]).tolist()
    assert matrix.inverse(many)[2, 3].tolist() == matrix.inverse(many[2, 3]).tolist()
    assert matrix.determinant(many).shape == (5, 7)
    for function in (matrix.transform_points, matrix.transform_directions):
        assert function(many, points)[2, 3].tolist() == function(many[2, 3], points[3]).tolist()
        assert function(many[0, 0], points)[3].tolist() == function(many[0, 0], points[3]).tolist()
        assert function(many, points[0]).shape == (5, 7, 3)
