"""What of shapes is drawn: surfaces that are closed, face outward and lie on the shape."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from shape_examples import EXAMPLES, ROUND, SOLID

from carom.systems.shapes.plane import Plane


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
