"""Shapes that cannot be are refused, with what is accepted and what came."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from faults import error

from carom.ecs.errors import DeclarationError
from carom.ecs.spatial import quaternion
from carom.systems.shapes import Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.sphere import Sphere


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
        (
            lambda: Cone(math.inf, 0.0),
            (
                "cone.radius: must be finite and above 0 m, received inf; "
                "cone.length: must be finite and above 0 m, received 0"
            ),
        ),
        (lambda: Ellipsoid((1.0, math.nan, -1.0)), "ellipsoid.radii: must be finite and above 0 m, received nan"),
        (lambda: Ellipsoid((1.0, 2.0)), "ellipsoid.radii: must be 3 numbers, received (1.0, 2.0)"),  # type: ignore[arg-type]
        (lambda: Box(2.0), "box.size: must be 3 numbers, received 2.0"),  # type: ignore[arg-type]
        (lambda: Box(([1.0], 2.0, 3.0)), "box.size: must be 3 numbers, received ([1.0], 2.0, 3.0)"),  # type: ignore[arg-type]
        (lambda: Sphere("1 m"), "sphere.radius: must be a number, received '1 m'"),  # type: ignore[arg-type]
        (lambda: Sphere((1.0,)), "sphere.radius: must be a number, received (1.0,)"),  # type: ignore[arg-type]
        (lambda: Sphere(True), "sphere.radius: must be a number, received True"),
        (
            lambda: Capsule("a", -1.0),  # type: ignore[arg-type]
            "capsule.radius: must be a number, received 'a'; capsule.length: must be finite and above 0 m, received -1",
        ),
        (lambda: Sphere(1e-110), "sphere: its volume must be from 2.2e-308 m3 on, received 0 m3"),
        (lambda: Box((1.0, 1e-200, 1e-200)), "box: its volume must be from 2.2e-308 m3 on, received 0 m3"),
        (lambda: Capsule(1e-320, 1.0), "capsule: its volume must be from 2.2e-308 m3 on, received 0 m3"),
        (lambda: Sphere(1e150), "sphere: its volume must be finite, received inf m3"),
        (lambda: Cylinder(1.0, 0.0), "cylinder.length: must be finite and above 0 m, received 0"),
        (lambda: Plane((0.0, 0.0, 0.0)), "plane.normal: must have a direction, received a zero vector"),
        (lambda: Plane((0.0, math.nan, 0.0)), "plane.normal: must be finite, received nan"),
        (lambda: Plane(offset=math.inf), "plane.offset: must be finite, received inf"),
    ],
)
def test_impossible_parameters_are_refused(make: Callable[[], Shape], message: str) -> None:
    """Each message names shape and parameter, what is accepted and what came."""
    with error(DeclarationError, message):
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
    with error(DeclarationError, message):
        hull_of(np.array(points))


def test_a_thin_body_has_a_hull() -> None:
    """A sheet of a millionth of its width has a volume."""
    hull = hull_of(np.array([*FLAT, [0.0, 0.0, 1e-6]]))
    assert Convex(hull).mass_properties().volume == pytest.approx(1e-6 / 3.0, rel=1e-6)
