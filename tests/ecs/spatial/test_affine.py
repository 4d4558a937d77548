"""Matrices that place things, made of parts and taken apart."""

from __future__ import annotations

import math

import numpy as np
import pytest
from drawn import EPSILON, apart, rotations, vectors
from hypothesis import given
from hypothesis import strategies as st

from carom.ecs.column import Floats
from carom.ecs.spatial import affine, matrix, quaternion
from carom.ecs.spatial.checks import GeometryError

factors = st.tuples(*[st.floats(0.1, 10.0)] * 3).map(np.array)
leans = st.tuples(*[st.floats(-2.0, 2.0)] * 3).map(np.array)


@given(rotations(), vectors)
def test_rotation_matrices_turn_as_quaternions_do(q: Floats, v: Floats) -> None:
    """Points and directions alike, about the origin."""
    wanted = quaternion.rotate(q, v)
    for transform in (matrix.transform_points, matrix.transform_directions):
        assert np.abs(transform(affine.rotation(q), v) - wanted).max() <= EPSILON * np.abs(v).max()


def test_scale_and_shear_by_axes() -> None:
    """Each factor acts on the axis it names; a shear keeps volumes."""
    assert matrix.transform_points(affine.scale((2, 3, -4)), (1, 1, 1)).tolist() == [2, 3, -4]
    for row, (a, first) in enumerate(zip("xyz", (1.0, 10.0, 100.0), strict=True)):
        for b, pushed in zip("xyz", (1.0, 10.0, 100.0), strict=True):
            if a != b:
                leaned = affine.shear(**{a + b: 0.5})
                found = matrix.transform_points(leaned, (1.0, 10.0, 100.0))
                assert found[row] == first + 0.5 * pushed
                assert sorted(np.delete(found, row)) == sorted({1.0, 10.0, 100.0} - {first})
                assert matrix.determinant(leaned) == 1.0


@given(vectors, rotations(), factors, leans)
def test_parts_come_back(offset: Floats, q: Floats, scale: Floats, lean: Floats) -> None:
    """The matrix is scale, shear, rotation, translation one after another, and comes apart into the same."""
    m = affine.compose(offset, q, scale, lean)
    xy, xz, yz = lean
    steps = [affine.translation(offset), affine.rotation(q), affine.shear(xy=xy, xz=xz, yz=yz), affine.scale(scale)]
    together = matrix.product(matrix.product(steps[0], steps[1]), matrix.product(steps[2], steps[3]))
    assert m == pytest.approx(together, rel=EPSILON, abs=1e-13)
    parts = affine.decompose(m)
    assert parts.translation.tolist() == offset.tolist()
    assert apart(parts.rotation, q) <= 1e-12
    assert parts.scale == pytest.approx(scale, rel=1e-12)
    assert parts.shear == pytest.approx(lean, abs=1e-10)
    assert affine.compose(*parts) == pytest.approx(m, abs=1e-12)


def test_a_mirror_is_a_negative_scale() -> None:
    """Along x, whichever axis was mirrored; the parts make the same matrix."""
    parts = affine.decompose(affine.scale([[-2.0, 3.0, 4.0], [2.0, -3.0, 4.0]]))
    assert parts.scale.tolist() == [[-2.0, 3.0, 4.0], [-2.0, 3.0, 4.0]]
    assert parts.rotation[0].tolist() == quaternion.IDENTITY.tolist()
    assert affine.compose(*parts)[1] == pytest.approx(np.diag([2.0, -3.0, 4.0, 1.0]), abs=EPSILON)


@given(vectors, rotations())
def test_the_rigid_inverse_is_the_inverse(offset: Floats, q: Floats) -> None:
    """And undoes points to roundings of the way."""
    m = affine.compose(offset, q)
    size = 1.0 + np.abs(offset).max()
    back = affine.inverse_rigid(m)
    assert np.abs(back - matrix.inverse(m)).max() <= 10.0 * EPSILON * size
    assert np.abs(matrix.product(back, m) - np.eye(4)).max() <= EPSILON * size


def test_what_does_not_come_apart_is_refused() -> None:
    """Flattened space, projections, and scale where only turns are taken."""
    flat = "^a matrix flattens space: its columns lie in one plane$"
    for scale in np.ones((3, 3)) - np.eye(3):
        with pytest.raises(GeometryError, match=flat):
            affine.decompose(affine.scale(scale))
    for call in (affine.decompose, affine.inverse_rigid):
        with pytest.raises(GeometryError, match=r"^a matrix is not affine: its last row is not 0 0 0 1$"):
            call(2.0 * np.eye(4))
    with pytest.raises(GeometryError, match=r"its columns are not orthonormal within 0.001$"):
        affine.inverse_rigid(affine.scale((1.0, 1.0, 1.01)))


def test_everything_works_over_arrays() -> None:
    """Leading axes broadcast, and one part may serve many others."""
    generator = np.random.default_rng(0)
    q, offset = quaternion.normalise(generator.normal(size=(7, 4))), generator.normal(size=(5, 7, 3))
    m = affine.compose(offset, q, scale=(1.0, 2.0, 0.5), shear=generator.normal(size=(7, 3)))
    assert m.shape == (5, 7, 4, 4)
    parts = affine.decompose(m)
    assert parts.rotation.shape == (5, 7, 4)
    assert parts.shear[2, 3].tolist() == affine.decompose(m[2, 3]).shear.tolist()
    rigid = affine.compose(offset, q)
    assert affine.inverse_rigid(rigid)[2, 3].tolist() == affine.inverse_rigid(rigid[2, 3]).tolist()
    assert affine.shear(xy=np.ones(6), zx=np.ones((2, 1))).shape == (2, 6, 4, 4)
    assert affine.rotation(quaternion.from_axis_angle((0, 0, 1), np.zeros(3))).shape == (3, 4, 4)
    assert math.isclose(matrix.determinant(affine.scale((2.0, 3.0, 4.0))), 24.0)
