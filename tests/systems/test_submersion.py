"""What of shapes lies below a plane, against slices of fine meshes and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from shape_examples import fine
from solids import CORNERS

from carom.ecs.column import Floats
from carom.ecs.errors import DeclarationError
from carom.ecs.spatial.vector import normalise
from carom.systems.kernels.submersion import CENTER, VOLUME, WHOLE
from carom.systems.shapes import SHAPES, Shape
from carom.systems.shapes.geometry import Geometry, hull_of
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.land import land
from carom.systems.shapes.mesh import Mesh

ANNULUS = trimesh.creation.annulus(r_min=0.3, r_max=0.7, height=0.4)
RING = Geometry(np.array(ANNULUS.vertices), np.array(ANNULUS.faces, np.int64))
VOLUMES = {
    "sphere": SHAPES["sphere"](radius=0.5),
    "ellipsoid": SHAPES["ellipsoid"](radii=(0.6, 0.2, 0.3)),
    "box": SHAPES["box"](size=(1.0, 0.6, 1.4)),
    "capsule": SHAPES["capsule"](radius=0.3, length=0.8),
    "cylinder": SHAPES["cylinder"](radius=0.4, length=1.0),
    "cone": SHAPES["cone"](radius=0.5, length=1.2),
    "convex": SHAPES["convex"](hull_of(CORNERS)),
    "mesh": Mesh(RING),
}


def submerged(shape: Shape, normal: Floats, depth: Floats) -> Floats:
    """Return the rows of one shape below many planes."""
    size = np.tile(np.array(shape.packed()), (len(depth), 1))
    return type(shape).submerged(size, getattr(shape, "geometry", None), normal, depth)


def sliced(mesh: trimesh.Trimesh, normal: Floats, depth: float) -> tuple[float, Floats]:
    """Return volume and centre of what trimesh cuts off; seen from the plane, the face it cuts open adds nothing."""
    origin = depth * normal
    vertices, faces, _ = trimesh.intersections.slice_faces_plane(mesh.vertices, mesh.faces, -normal, origin)
    corners = vertices[faces] - origin
    volumes = np.linalg.det(corners) / 6.0
    return float(volumes.sum()), origin + (volumes[:, None] * corners.sum(axis=1) / 4.0).sum(axis=0) / volumes.sum()


@pytest.mark.parametrize("key", VOLUMES)
def test_volume_and_centre_are_those_of_a_slice(key: str) -> None:
    """A hundred planes each: within 1 % of what trimesh cuts off, centres 1 % of its draught; the whole is exact."""
    shape, draws = VOLUMES[key], np.random.default_rng(1)
    mesh, normal = fine(key, shape, subdivisions=5, sections=128), normalise(draws.normal(size=(100, 3)))
    reach = mesh.vertices @ normal.T
    low, high = reach.min(axis=0), reach.max(axis=0)
    depth = low + (high - low) * draws.uniform(0.02, 0.98, 100)
    found = submerged(shape, normal, depth)
    for row, across, level, lowest in zip(found, normal, depth, low, strict=True):
        volume, center = sliced(mesh, across, level)
        assert row[VOLUME] == pytest.approx(volume, rel=0.01)
        assert np.linalg.norm(row[CENTER:WHOLE] - center) < 0.01 * (level - lowest)
    assert found[:, WHOLE] == pytest.approx(shape.mass_properties().volume, rel=1e-12)


@pytest.mark.parametrize("key", VOLUMES)
def test_all_and_nothing(key: str) -> None:
    """Far below the surface it is all of the shape, about its centre; above, nothing."""
    shape, up = VOLUMES[key], normalise(np.array([[1.0, 2.0, 3.0], [-1.0, 0.0, 0.5], [0.0, 1.0, 0.0]]))
    mass = shape.mass_properties()
    for far in (10.0, 1e9, np.inf):
        found = submerged(shape, up, np.full(3, far))
        assert found[:, VOLUME] == pytest.approx(mass.volume, rel=1e-12)
        assert found[:, CENTER:WHOLE] == pytest.approx(np.tile(mass.center, (3, 1)), abs=1e-12)
    assert (submerged(shape, up, np.full(3, -10.0))[:, VOLUME] == 0.0).all()


def test_solids_of_revolution_do_not_know_their_facets() -> None:
    """Turned about their axis, the centre of what is below stays in the plane of axis and normal: nothing spins."""
    angles = np.linspace(0.0, 1.0, 50)
    normal = normalise(np.stack([np.cos(angles), np.full(50, 0.7), np.sin(angles)], axis=1))
    for key in ("capsule", "cylinder", "cone"):
        found = submerged(VOLUMES[key], normal, np.full(50, 0.05))
        assert np.ptp(found[:, VOLUME]) < 1e-14
        assert np.abs(found[:, 1] * normal[:, 2] - found[:, 3] * normal[:, 0]).max() < 1e-15


def test_a_point_displaces_nothing() -> None:
    """It has no volume."""
    assert not submerged(SHAPES["point"](), np.array([[0.0, 1.0, 0.0]]), np.ones(1)).any()


@pytest.mark.parametrize("shape", [SHAPES["plane"](), HeightField(land(np.zeros((2, 2)), 1.0, 1.0, "heights"))])
def test_what_goes_on_for_ever_is_refused(shape: Shape) -> None:
    """Planes and land have no volume that could be borne."""
    with pytest.raises(DeclarationError) as caught:
        submerged(shape, np.array([[0.0, 1.0, 0.0]]), np.ones(1))
    assert str(caught.value) == f"{shape.key}: has no volume known that a medium could bear"


def test_an_open_mesh_has_no_volume() -> None:
    """It is refused, and told how many edges are loose."""
    hole = Mesh(Geometry(RING.vertices, RING.faces[1:], "mesh file ring.stl"))
    with pytest.raises(DeclarationError) as caught:
        submerged(hole, np.array([[0.0, 1.0, 0.0]]), np.ones(1))
    assert str(caught.value) == (
        "mesh file ring.stl is open: 3 edges do not join two faces, so it has no volume; close its holes, or use convex"
    )
