"""Every shape of the registry: bounds, support, corners, size column and FCL geometry."""

from __future__ import annotations

import math

import numpy as np
import pytest
from shape_examples import ENDLESS, EXAMPLES, ROUND, SOLID, fine

from carom.ecs.spatial import quaternion
from carom.systems.shapes import SHAPES
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.orientation import Z_TO_Y, wxyz_from_xyzw
from carom.systems.shapes.plane import Plane

DIRECTIONS = quaternion.normalise(np.random.default_rng(1).normal(size=(200, 3)))
AXES = np.concatenate([np.eye(3), -np.eye(3)])


def test_every_shape_is_here() -> None:
    """A new shape must join this suite; its number is its own and its parameters have unit and doc."""
    assert set(EXAMPLES) == set(SHAPES)
    assert len({kind.number for kind in SHAPES.values()}) == len(SHAPES)
    for kind in SHAPES.values():
        assert all(field.metadata["unit"] and field.metadata["doc"] for field in kind.parameters())


@pytest.mark.parametrize("key", [key for key in EXAMPLES if key != "plane"])
def test_bounds_are_tight(key: str) -> None:
    """The farthest points along the axes lie on the sides of the bounds, to rounding."""
    shape = EXAMPLES[key]()
    bounds, found = shape.bounds(), shape.support(AXES)
    reach = np.array(bounds.half) + bounds.radius
    assert np.diag(found[:3]) - bounds.center == pytest.approx(reach, abs=1e-15)
    assert bounds.center - np.diag(found[3:]) == pytest.approx(reach, abs=1e-15)


@pytest.mark.parametrize("key", [key for key in EXAMPLES if key not in ("plane", "point")])
def test_the_support_point_is_the_farthest(key: str) -> None:
    """No vertex of a fine surface lies farther in any direction, and one lies as far up to the tessellation.

    The gap beside a support point is the sagitta of half a facet: that of 400 around, or of a ball's 0.7 degrees.
    """
    shape = EXAMPLES[key]()
    vertices = fine(key, shape).vertices
    farthest = (shape.support(DIRECTIONS) * DIRECTIONS).sum(axis=1)
    gap = farthest - (DIRECTIONS @ vertices.T).max(axis=1)
    assert gap.min() >= -1e-9  # trimesh's vertices are themselves rounded
    assert gap.max() <= (1e-4 if key in ROUND else 1e-12)


@pytest.mark.parametrize("key", SOLID)
def test_the_support_point_belongs_to_the_shape(key: str) -> None:
    """In no other direction does it stand out beyond what is farthest there, nor does its length matter."""
    shape = EXAMPLES[key]()
    points = shape.support(DIRECTIONS)
    reach = (points * DIRECTIONS).sum(axis=1)
    assert (DIRECTIONS @ points.T - reach[:, None]).max() <= 1e-15
    for length in (1e-200, 1e3, 1e200):
        assert shape.support(length * DIRECTIONS) == pytest.approx(points, abs=1e-15)


def test_support_where_many_points_are_equally_far() -> None:
    """Level, upright and along an edge: always one point, and one of those farthest."""
    for key in (*ROUND, "box"):
        shape = EXAMPLES[key]()
        for direction in np.array([[0, 1, 0], [0, -1, 0], [1, 0, 0], [0, 0, -1], [1, 0, 1], [2.75, 1, 0]], float):
            point = shape.support(direction[None])[0]
            assert np.isfinite(point).all()
            vertices = fine(key, shape).vertices
            assert (point @ direction) - (vertices @ direction).max() >= -1e-9


def test_land_and_planes_go_on_for_ever() -> None:
    """A half space ends only along its normal."""
    plane = EXAMPLES["plane"]()
    found = plane.support(np.array([[0.0, 6.0, 8.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]))
    assert found[0].tolist() == pytest.approx([0.0, -0.3, -0.4], abs=1e-15)
    assert found[1:].tolist() == [[0.0, math.inf, 0.0], [-math.inf, 0.0, 0.0]]
    for key in ENDLESS:
        assert EXAMPLES[key]().mass_properties().volume == math.inf


@pytest.mark.parametrize("key", SOLID)
def test_fcl_ends_where_support_says(key: str) -> None:
    """FCL's geometry meets a small ball put just within the farthest point, and misses one just beyond it."""
    import fcl

    shape, size = EXAMPLES[key](), 0.02
    turn = fcl.Transform(wxyz_from_xyzw(np.array(Z_TO_Y)), np.zeros(3)) if shape.along_z else fcl.Transform()
    placed = fcl.CollisionObject(shape.fcl_geometry(), turn)
    for direction in np.concatenate([DIRECTIONS[:30], AXES]):
        end = shape.support(direction[None])[0]
        for gap, met in ((-1e-4, True), (1e-4, False)):
            ball = fcl.CollisionObject(fcl.Sphere(size), fcl.Transform(end + (size + gap) * direction))
            assert (fcl.collide(placed, ball, fcl.CollisionRequest(), fcl.CollisionResult()) > 0) is met


@pytest.mark.parametrize("key", EXAMPLES)
def test_the_size_column_holds_the_shape(key: str) -> None:
    """What `packed` writes, `from_size` reads back as the same shape."""
    shape = EXAMPLES[key]()
    size = np.array(shape.packed())
    assert size.shape == (4,)
    assert type(shape).from_size(size, getattr(shape, "geometry", None)) == shape


@pytest.mark.parametrize("key", ["sphere", "box", "capsule", "convex", "cylinder", "cone", "ellipsoid"])
def test_a_half_space_meets_the_corners_first(key: str) -> None:
    """In no direction is a point of the solid farther out than the corner balls, nor is there room between."""
    shape = EXAMPLES[key]()
    vertices = fine(key, shape).vertices
    for direction in quaternion.normalise(np.random.default_rng(1).normal(size=(50, 3))):
        corners, radius = shape.corners(tuple(direction))
        gap = (corners @ direction).max() + radius - (vertices @ direction).max()
        assert -1e-12 <= gap <= 1e-4


@pytest.mark.parametrize("key", EXAMPLES)
@pytest.mark.parametrize("margin", [0.0, 0.01])
def test_fcl_can_build_it(key: str, margin: float) -> None:
    """Each shape, also grown, makes an FCL object that collides with a ball at its centre of mass or on its surface."""
    import fcl

    shape = EXAMPLES[key]()
    at = np.array(shape.normal) * shape.offset if isinstance(shape, Plane) else shape.mass_properties().center
    size = 2.0 if isinstance(shape, Mesh) else 0.1  # a mesh is hollow
    ball = fcl.CollisionObject(fcl.Sphere(size), fcl.Transform(np.array(at)))
    if isinstance(shape, Plane):
        assert np.linalg.norm(shape.normal) == pytest.approx(1.0, rel=1e-15)
    placed = fcl.CollisionObject(shape.fcl_geometry(margin), fcl.Transform())
    assert fcl.collide(placed, ball, fcl.CollisionRequest(), fcl.CollisionResult()) >= 1


@pytest.mark.parametrize("size", [5e-324, 1e-200, 1e-3, 1.0, 1e200, 1e307])
def test_a_plane_takes_a_normal_of_any_length(size: float) -> None:
    """Also where its square is no number of its own."""
    assert Plane((0.0, size, 0.0)).normal == (0.0, 1.0, 0.0)
    if size >= 1e-200:
        assert Plane((3.0 * size, 0.0, -4.0 * size)).normal == pytest.approx((0.6, 0.0, -0.8), abs=1e-15)
