"""What shapes weigh: volume, centre and moments, in closed form and by a fine mesh."""

from __future__ import annotations

import math
import os
import subprocess
import sys

import numpy as np
import pytest
from shape_examples import EXAMPLES, ROUND, SOLID, TETRAHEDRON, fine

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.shapes import Shape
from carom.systems.shapes.capsule import Capsule

# How far a fine surface lies inside a round shape, as a share: 400 facets around cut 1 - cos(pi / 400) = 3.1e-5 off a
# radius, so twice that off a cross-section; a ball of 81,920 triangles lacks 1.6e-4 of its volume, and moments lack
# up to 5 / 3 of what the volume does.
FINE = 3e-4


def inertia_matrix(shape: Shape) -> Floats:
    """Return the inertia over mass (m2) in the shape frame, from principal moments and axes."""
    solid = shape.mass_properties()
    axes = quaternion.matrix(solid.axes)
    return np.asarray(axes @ np.diag(solid.inertia) @ axes.T)


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
