"""Every shape of the registry: mass, bounds, corners, surface and FCL geometry."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import trimesh

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.shapes import SHAPES, Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.geometry import Geometry, hull_of
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.orientation import Z_TO_Y, along_y, wxyz_from_xyzw
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.point import Point
from carom.systems.shapes.sphere import Sphere

TETRAHEDRON = np.array([[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.2, 0.8, 0.1], [0.1, 0.3, 1.5]])


def ring() -> Geometry:
    """Return a sheared ring beside the origin: hollow, and its principal axes are not the coordinate axes."""
    mesh = trimesh.creation.annulus(r_min=0.3, r_max=0.7, height=0.4)
    shear = np.array([[1.0, 0.4, 0.0], [0.0, 1.0, 0.3], [0.0, 0.0, 1.0]])
    return Geometry(mesh.vertices @ shear + [0.5, 0.0, 0.1], np.array(mesh.faces, np.int64), "ring")


HILLS = [[0.0, 0.4, 0.1], [0.3, 1.0, -0.2], [0.2, 0.0, 0.5], [0.1, 0.1, 0.1]]

EXAMPLES: dict[str, Callable[[], Any]] = {
    "sphere": lambda: Sphere(0.7),
    "box": lambda: Box((0.3, 0.5, 0.8)),
    "plane": lambda: Plane((0.0, 3.0, 4.0), -0.5),
    "point": lambda: Point(),
    "capsule": lambda: Capsule(0.4, 1.1),
    "cylinder": lambda: Cylinder(0.4, 1.1),
    "cone": lambda: Cone(0.4, 1.1),
    "ellipsoid": lambda: Ellipsoid((0.3, 0.7, 0.5)),
    "convex": lambda: Convex(hull_of(TETRAHEDRON)),
    "mesh": lambda: Mesh(ring()),
    "height_field": lambda: HeightField.stated(heights=HILLS, spacing=[0.5, 0.8]),
}
ENDLESS = ("plane", "height_field")  # no volume, since there is no end to it
SOLID = [key for key in EXAMPLES if key not in (*ENDLESS, "point")]
ROUND = ("sphere", "capsule", "cylinder", "cone", "ellipsoid")

# How far a fine surface lies inside a round shape, as a share: 400 facets around cut 1 - cos(pi / 400) = 3.1e-5 off a
# radius, so twice that off a cross-section; a ball of 81,920 triangles lacks 1.6e-4 of its volume, and moments lack
# up to 5 / 3 of what the volume does.
FINE = 3e-4
DIRECTIONS = quaternion.normalise(np.random.default_rng(1).normal(size=(200, 3)))
AXES = np.concatenate([np.eye(3), -np.eye(3)])


def fine(key: str, shape: Any) -> trimesh.Trimesh:
    """Return a solid's surface with so many triangles that it is right to `FINE`."""
    if key in ("sphere", "ellipsoid"):
        ball = trimesh.creation.icosphere(subdivisions=6)
        return trimesh.Trimesh(ball.vertices * (shape.radius if key == "sphere" else shape.radii), ball.faces)
    if key == "capsule":
        mesh = trimesh.creation.capsule(height=shape.length, radius=shape.radius, count=[400, 400])
        return trimesh.Trimesh(along_y(mesh.vertices), mesh.faces)
    if key == "cylinder":
        mesh = trimesh.creation.cylinder(radius=shape.radius, height=shape.length, sections=400)
        return trimesh.Trimesh(along_y(mesh.vertices), mesh.faces)
    if key == "cone":  # trimesh's stands on its base
        mesh = trimesh.creation.cone(radius=shape.radius, height=shape.length, sections=400)
        return trimesh.Trimesh(along_y(mesh.vertices) - [0.0, shape.length / 2.0, 0.0], mesh.faces)
    surface = shape.surface()
    return trimesh.Trimesh(surface.vertices, surface.faces)


def inertia_matrix(shape: Shape) -> Floats:
    """Return the inertia over mass (m2) in the shape frame, from principal moments and axes."""
    solid = shape.mass_properties()
    axes = quaternion.matrix(solid.axes)
    return np.asarray(axes @ np.diag(solid.inertia) @ axes.T)


def test_every_shape_is_here() -> None:
    """A new shape must join this suite; its number is its own and its parameters have unit and doc."""
    assert set(EXAMPLES) == set(SHAPES)
    assert len({kind.number for kind in SHAPES.values()}) == len(SHAPES)
    for kind in SHAPES.values():
        assert all(field.metadata["unit"] and field.metadata["doc"] for field in kind.parameters())


@pytest.mark.parametrize("key", SOLID)
def test_mass_agrees_with_a_fine_mesh(key: str) -> None:
    """Volume, centre and inertia are those of the solid within a fine surface, which is never the larger."""
    shape = EXAMPLES[key]()
    mesh, solid = fine(key, shape), shape.mass_properties()
    within = FINE if key in ROUND else 1e-12
    assert -1e-12 <= 1.0 - mesh.volume / solid.volume <= within
    assert np.array(solid.center) == pytest.approx(mesh.center_mass, abs=1e-9)
    scale = max(solid.inertia)
    assert inertia_matrix(shape) == pytest.approx(mesh.moment_inertia / mesh.volume, abs=within * scale)


@pytest.mark.parametrize(
    ("key", "volume", "moments"),
    [
        ("sphere", 4 / 3 * math.pi * 0.343, [0.4 * 0.49] * 3),
        ("box", 0.12, [(0.25 + 0.64) / 12, (0.09 + 0.64) / 12, (0.09 + 0.25) / 12]),
        (
            "cylinder",
            math.pi * 0.16 * 1.1,
            [0.16 / 4 + 1.21 / 12, 0.16 / 2, 0.16 / 4 + 1.21 / 12],
        ),
        (
            "cone",
            math.pi * 0.16 * 1.1 / 3,
            [3 / 20 * 0.16 + 3 / 80 * 1.21, 3 / 10 * 0.16, 3 / 20 * 0.16 + 3 / 80 * 1.21],
        ),
        ("ellipsoid", 4 / 3 * math.pi * 0.105, [(0.49 + 0.25) / 5, (0.09 + 0.25) / 5, (0.09 + 0.49) / 5]),
    ],
)
def test_mass_in_closed_form(key: str, volume: float, moments: list[float]) -> None:
    """Textbook moments to rounding."""
    solid = EXAMPLES[key]().mass_properties()
    assert solid.volume == pytest.approx(volume, rel=1e-14)
    assert list(solid.inertia) == pytest.approx(moments, rel=1e-14)


def test_a_capsule_lies_between_its_limits() -> None:
    """With a vanishing tube it is a ball, with vanishing caps a rod."""
    ball, rod = Capsule(0.5, 1e-12).mass_properties(), Capsule(1e-7, 3.0).mass_properties()
    assert ball.inertia == pytest.approx([0.1] * 3, rel=1e-10)
    assert rod.inertia[0] == pytest.approx(9.0 / 12.0, rel=1e-6)


def test_a_tetrahedron_in_closed_form() -> None:
    """V = det / 6; with the vertices about the centroid, the second moment is their sum of squares over 20 (m2)."""
    shape = EXAMPLES["convex"]()
    solid = shape.mass_properties()
    edges = TETRAHEDRON[1:] - TETRAHEDRON[0]
    around = TETRAHEDRON - TETRAHEDRON.mean(axis=0)
    second = around.T @ around / 20.0
    assert solid.volume == pytest.approx(np.linalg.det(edges) / 6.0, rel=1e-12)
    assert np.array(solid.center) == pytest.approx(TETRAHEDRON.mean(axis=0), rel=1e-12)
    assert inertia_matrix(shape) == pytest.approx(np.trace(second) * np.eye(3) - second, abs=1e-13)


MASS = """
import numpy as np
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import hull_of
print([Convex(hull_of(np.random.default_rng(k).normal(size=(20, 3)))).mass_properties() for k in range(9)])
"""


def test_the_mass_of_a_hull_is_the_same_on_every_processor() -> None:
    """Mass is state: with the linear algebra of an old processor not a bit differs."""
    printed = [
        subprocess.run(
            [sys.executable, "-c", MASS], env=os.environ | environment, capture_output=True, text=True, check=True
        ).stdout
        for environment in ({}, {"OPENBLAS_CORETYPE": "Prescott"})
    ]
    assert len(printed[0]) > 1000
    assert printed[0] == printed[1]


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


@pytest.mark.parametrize("key", SOLID)
def test_the_surface_is_closed_and_faces_outward(key: str) -> None:
    """What is drawn encloses the solid's volume, up to 2 % that flat triangles take off round shapes."""
    shape = EXAMPLES[key]()
    surface = shape.surface()
    mesh = trimesh.Trimesh(surface.vertices, surface.faces)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert len(mesh.faces) <= 4096
    assert -1e-12 <= 1.0 - mesh.volume / shape.mass_properties().volume <= (0.02 if key in ROUND else 1e-12)


@pytest.mark.parametrize("key", [*ROUND, "box", "convex"])
def test_the_surface_lies_on_the_shape(key: str) -> None:
    """Each drawn triangle lies inside the shape, and nowhere deeper than half a percent of its size.

    A facet of 1/32 of a turn, the coarsest here, lies 1 - cos(pi / 32) = 0.48 % of the radius below the arc.
    """
    shape = EXAMPLES[key]()
    surface = shape.surface()
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    outward = np.cross(b - a, c - a)
    outward /= np.linalg.norm(outward, axis=1)[:, None]
    depth = ((shape.support(outward) - a) * outward).sum(axis=1)
    size = max(shape.bounds().half) + shape.bounds().radius
    assert depth.min() >= -1e-9 * size
    assert depth.max() <= (5e-3 * size if key in ROUND else 1e-12)


def test_land_is_drawn_as_it_is_stated() -> None:
    """Two triangles for each cell, all facing up; the first row lies at the back, the first height of each at -x."""
    land = EXAMPLES["height_field"]()
    surface = land.surface()
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    assert len(surface.faces) == 12
    assert np.cross(b - a, c - a)[:, 1].min() > 0.0
    assert surface.vertices[:3] == pytest.approx(np.array([[-0.5, 0.0, -1.2], [0.0, 0.4, -1.2], [0.5, 0.1, -1.2]]))
    assert surface.vertices[-1] == pytest.approx([0.5, 0.1, 1.2])
    assert land.bounds().half == pytest.approx((0.5, 0.6, 1.2))


@pytest.mark.parametrize("key", ["plane", "point"])
def test_shapes_without_volume_are_drawn_too(key: str) -> None:
    """A plane is a square in itself, a point a small ball about itself."""
    shape = EXAMPLES[key]()
    vertices = shape.surface().vertices
    if isinstance(shape, Plane):
        assert vertices @ shape.normal == pytest.approx([shape.offset] * 4, abs=1e-12)
    else:
        assert np.linalg.norm(vertices, axis=1) == pytest.approx([0.01] * len(vertices), rel=1e-6)


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
