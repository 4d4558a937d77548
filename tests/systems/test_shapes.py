"""Every shape of the registry: mass, bounds, corners, surface, FCL geometry, and what it refuses."""

from __future__ import annotations

import math
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from carom.ecs import DeclarationError
from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.shapes import SHAPES, Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.geometry import Geometry, hull_of, load_geometry
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.orientation import along_y
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.point import Point
from carom.systems.shapes.sphere import Sphere

TETRAHEDRON = np.array([[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.2, 0.8, 0.1], [0.1, 0.3, 1.5]])


def ring() -> Geometry:
    """Return a sheared ring beside the origin: hollow, and its principal axes are not the coordinate axes."""
    mesh = trimesh.creation.annulus(r_min=0.3, r_max=0.7, height=0.4)
    shear = np.array([[1.0, 0.4, 0.0], [0.0, 1.0, 0.3], [0.0, 0.0, 1.0]])
    return Geometry(mesh.vertices @ shear + [0.5, 0.0, 0.1], np.array(mesh.faces, np.int64), "ring")


EXAMPLES: dict[str, Callable[[], Shape]] = {
    "sphere": lambda: Sphere(0.7),
    "box": lambda: Box((0.3, 0.5, 0.8)),
    "plane": lambda: Plane((0.0, 3.0, 4.0), -0.5),
    "point": lambda: Point(),
    "capsule": lambda: Capsule(0.4, 1.1),
    "cylinder": lambda: Cylinder(0.4, 1.1),
    "convex": lambda: Convex(hull_of(TETRAHEDRON)),
    "mesh": lambda: Mesh(ring()),
}
SOLID = ["sphere", "box", "capsule", "cylinder", "convex", "mesh"]


def fine(key: str, shape: Any) -> trimesh.Trimesh:
    """Return a solid's surface with so many triangles that it is right to 3e-4."""
    if key == "sphere":
        return trimesh.creation.icosphere(subdivisions=6, radius=shape.radius)
    if key == "capsule":
        mesh = trimesh.creation.capsule(height=shape.length, radius=shape.radius, count=[400, 400])
        return trimesh.Trimesh(along_y(mesh.vertices), mesh.faces)
    if key == "cylinder":
        mesh = trimesh.creation.cylinder(radius=shape.radius, height=shape.length, sections=1000)
        return trimesh.Trimesh(along_y(mesh.vertices), mesh.faces)
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
    assert {key for key, kind in SHAPES.items() if kind.solid and not kind.static} | {"mesh"} == set(SOLID)


@pytest.mark.parametrize("key", SOLID)
def test_mass_agrees_with_a_fine_mesh(key: str) -> None:
    """Volume, centre and inertia are those of the solid within a fine surface, to 3e-4: what tessellation takes."""
    shape = EXAMPLES[key]()
    mesh, solid = fine(key, shape), shape.mass_properties()
    assert solid.volume == pytest.approx(mesh.volume, rel=3e-4)
    assert np.array(solid.center) == pytest.approx(mesh.center_mass, abs=1e-9)
    scale = max(solid.inertia)
    assert inertia_matrix(shape) == pytest.approx(mesh.moment_inertia / mesh.volume, abs=3e-4 * scale)


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


@pytest.mark.parametrize("key", SOLID)
def test_bounds_hold_the_surface_and_fit(key: str) -> None:
    """No point of the surface lies beyond the bounds, and each side of them is reached within 1 %."""
    shape = EXAMPLES[key]()
    bounds, vertices = shape.bounds(), fine(key, shape).vertices
    away = vertices - bounds.center
    beyond = away - np.clip(away, -np.array(bounds.half), bounds.half)
    assert np.linalg.norm(beyond, axis=1).max() <= bounds.radius + 1e-12
    reach = np.array(bounds.half) + bounds.radius
    assert away.max(axis=0) == pytest.approx(reach, rel=0.01)
    assert away.min(axis=0) == pytest.approx(-reach, rel=0.01)


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
    assert mesh.volume == pytest.approx(shape.mass_properties().volume, rel=0.02)


@pytest.mark.parametrize("key", ["plane", "point"])
def test_shapes_without_volume_are_drawn_too(key: str) -> None:
    """A plane is a square in itself, a point a small ball about itself."""
    shape = EXAMPLES[key]()
    vertices = shape.surface().vertices
    if isinstance(shape, Plane):
        assert vertices @ shape.normal == pytest.approx([shape.offset] * 4, abs=1e-12)
    else:
        assert np.linalg.norm(vertices, axis=1) == pytest.approx([0.01] * len(vertices), rel=1e-6)


@pytest.mark.parametrize("key", ["sphere", "box", "capsule", "convex", "cylinder"])
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
    """Each shape, also grown, makes an FCL object that collides with a ball at its centre of mass, or on its plane."""
    import fcl

    shape = EXAMPLES[key]()
    at = np.array(shape.normal) * shape.offset if isinstance(shape, Plane) else shape.mass_properties().center
    size = 2.0 if key == "mesh" else 0.1  # a mesh is hollow
    ball = fcl.CollisionObject(fcl.Sphere(size), fcl.Transform(np.array(at)))
    if isinstance(shape, Plane):
        assert np.linalg.norm(shape.normal) == pytest.approx(1.0, rel=1e-15)
    placed = fcl.CollisionObject(shape.fcl_geometry(margin), fcl.Transform())
    assert fcl.collide(placed, ball, fcl.CollisionRequest(), fcl.CollisionResult()) >= 1


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Sphere(0.0), "sphere.radius: must be finite and above 0 m, received 0"),
        (lambda: Sphere(-1.0), "sphere.radius: must be finite and above 0 m, received -1"),
        (lambda: Sphere(math.nan), "sphere.radius: must be finite and above 0 m, received nan"),
        (lambda: Box((1.0, 0.0, -2.0)), "box.size: must be finite and above 0 m, received 0"),
        (lambda: Box((1.0, math.inf, 1.0)), "box.size: must be finite and above 0 m, received inf"),
        (
            lambda: Capsule(0.0, -1.0),
            (
                "capsule.radius: must be finite and above 0 m, received 0; "
                "capsule.length: must be finite and above 0 m, received -1"
            ),
        ),
        (lambda: Cylinder(1.0, 0.0), "cylinder.length: must be finite and above 0 m, received 0"),
        (lambda: Plane((0.0, 0.0, 0.0)), "plane.normal: must have a direction, received a zero vector"),
        (lambda: Plane((0.0, math.nan, 0.0)), "plane.normal: must be finite, received nan"),
        (lambda: Plane(offset=math.inf), "plane.offset: must be finite, received inf"),
    ],
)
def test_impossible_parameters_are_refused(make: Callable[[], Shape], message: str) -> None:
    """Each message names shape and parameter, what is accepted and what came."""
    with pytest.raises(DeclarationError, match=f"^{re.escape(message)}$"):
        make()


FLAT = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]
TURNED = (np.array(FLAT) @ quaternion.matrix(quaternion.normalise([1.0, 2.0, 3.0, 4.0])) + 1e3).tolist()
IN_A_PLANE = "points: the points lie in one plane, so their hull has no volume"


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (FLAT[:3], "points: a convex hull needs at least 4 points, received 3"),
        (FLAT, IN_A_PLANE),
        (TURNED, IN_A_PLANE),
        ([[float(k)] * 3 for k in range(5)], IN_A_PLANE),
        ([[1.0, 2.0, 3.0]] * 4, IN_A_PLANE),
        ([*FLAT, [0.0, math.nan, 1.0]], "points: points must be finite, received [0.0, nan, 1.0] as point 4"),
    ],
    ids=["too few", "flat", "flat and turned, far out", "on a line", "one point", "NaN"],
)
def test_points_without_volume_have_no_hull(points: list[list[float]], message: str) -> None:
    """Points in a plane are refused however they are turned, without a warning of qhull's."""
    with pytest.raises(DeclarationError, match=f"^{re.escape(message)}$"):
        hull_of(np.array(points))


def test_a_thin_body_has_a_hull() -> None:
    """A sheet of a millionth of its width has a volume."""
    hull = hull_of(np.array([*FLAT, [0.0, 0.0, 1e-6]]))
    assert Convex(hull).mass_properties().volume == pytest.approx(1e-6 / 3.0, rel=1e-6)


def write(path: Path, mesh: trimesh.Trimesh) -> Path:
    """Write a mesh file."""
    mesh.export(path)
    return path


@pytest.mark.parametrize("ending", ["obj", "stl", "ply", "glb"])
def test_a_mesh_file_is_read_and_scaled(ending: str, tmp_path: Path) -> None:
    """OBJ, STL, PLY and glTF hold the same solid."""
    path = write(tmp_path / f"box.{ending}", trimesh.creation.box(extents=(1.0, 2.0, 3.0)))
    solid = Mesh(load_geometry(path, 0.1)).mass_properties()
    assert solid.volume == pytest.approx(6e-3, rel=1e-6)
    assert sorted(solid.inertia) == pytest.approx([0.05 / 12, 0.10 / 12, 0.13 / 12], rel=1e-6)


def test_a_missing_mesh_file(tmp_path: Path) -> None:
    """The path is in the message."""
    message = f"mesh file {tmp_path}/none.obj does not exist"
    with pytest.raises(DeclarationError, match=f"^{re.escape(message)}$"):
        load_geometry(tmp_path / "none.obj")


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("words.obj", "hello world\n", "holds no triangles"),
        ("words.stl", "hello", "holds no triangles"),
        ("empty.stl", "", "holds no triangles"),
        ("words.ply", "hello", "cannot be read: Not a ply file!"),
        ("words.yaml", "hello: 1", "cannot be read: file_type 'yaml' not supported"),
    ],
)
def test_a_file_that_is_no_mesh(name: str, text: str, said: str, tmp_path: Path) -> None:
    """A file without triangles says so, whatever its name promises."""
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(DeclarationError, match=f"^{re.escape(f'mesh file {path} {said}')}$"):
        load_geometry(path)


def test_an_open_or_inverted_mesh_file(tmp_path: Path) -> None:
    """What encloses no volume, or encloses it inside out, says how to mend it."""
    box = trimesh.creation.box()
    path = write(tmp_path / "open.stl", trimesh.Trimesh(box.vertices, box.faces[:-1]))
    message = f"mesh file {path} is open: 11 faces do not close a volume; close its holes, or use convex"
    with pytest.raises(DeclarationError, match=f"^{re.escape(message)}$"):
        load_geometry(path)
    path = write(tmp_path / "inverted.stl", trimesh.Trimesh(box.vertices, box.faces[:, ::-1]))
    message = f"mesh file {path} is inverted: its volume is -0.008 m3; turn its faces outward"
    with pytest.raises(DeclarationError, match=f"^{re.escape(message)}$"):
        load_geometry(path, 0.2)
