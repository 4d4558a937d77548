"""FCL's path gives up to eight points wherever flat or straight features meet, and they keep their numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from pairs import Pair, Poses

from carom.ecs.spatial import quaternion
from carom.systems.constants import OVER_EDGE
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.sphere import Sphere

UP = np.array(quaternion.IDENTITY)
LYING = quaternion.from_axis_angle(np.array([0.0, 0.0, 1.0]), np.pi / 2.0)  # y along -x
DOWN = quaternion.from_axis_angle(np.array([0.0, 0.0, 1.0]), np.pi)
TIPPED = quaternion.from_axis_angle(np.array([0.0, 0.0, 1.0]), np.pi / 4.0)
SLOPE = np.arctan2(0.4, 1.0)  # of a cone of radius 0.4 and length 1 to its axis
ON_ITS_SIDE = quaternion.from_axis_angle(np.array([0.0, 0.0, 1.0]), np.pi / 2.0 + SLOPE)

TABLE, FLOOR, CAN, DISC = Box((4.0, 1.0, 4.0)), Plane(offset=0.5), Cylinder(0.4, 1.0), Cylinder(1.0, 1.0)
CONE, ROD, CUBE = Cone(0.4, 1.0), Capsule(0.2, 1.0), Box((0.8, 0.8, 0.8))
# What lies on what, how it is turned, how high above it its centre is, and where the points are, seen from there.
SQUARE = {(x, z) for x in (-0.4, 0.4) for z in (-0.4, 0.4)}
RIM = {(0.4, 0.0), (-0.4, 0.0), (0.0, 0.4), (0.0, -0.4)}
BETWEEN = {(x * np.sqrt(0.5), z * np.sqrt(0.5)) for x, z in SQUARE}  # of a rim that touches, but not of one apart
ENDS = {(0.5, 0.0), (-0.5, 0.0)}
RESTING: dict[str, tuple[Any, Any, Any, float, set[tuple[float, float]]]] = {
    "box on box": (TABLE, CUBE, UP, 0.4, SQUARE),
    "box on its edge": (TABLE, CUBE, TIPPED, 0.4 * np.sqrt(2.0), {(0.0, 0.4), (0.0, -0.4)}),
    "box on cylinder": (DISC, CUBE, UP, 0.4, SQUARE),
    "box on plane": (FLOOR, CUBE, UP, 0.4, SQUARE),
    "box on its edge on plane": (FLOOR, CUBE, TIPPED, 0.4 * np.sqrt(2.0), {(0.0, 0.4), (0.0, -0.4)}),
    "cylinder standing on box": (TABLE, CAN, UP, 0.5, RIM),
    "cylinder standing on plane": (FLOOR, CAN, UP, 0.5, RIM),
    "cylinder standing on cylinder": (DISC, CAN, UP, 0.5, RIM),
    "cylinder lying on box": (TABLE, CAN, LYING, 0.4, ENDS),
    "cylinder lying on plane": (FLOOR, CAN, LYING, 0.4, ENDS),
    "cylinder lying on cylinder": (DISC, CAN, LYING, 0.4, ENDS),
    "capsule lying on box": (TABLE, ROD, LYING, 0.2, ENDS),
    "capsule lying on cylinder": (DISC, ROD, LYING, 0.2, ENDS),
    "capsule lying on plane": (FLOOR, ROD, LYING, 0.2, ENDS),
    "capsule standing on box": (TABLE, ROD, UP, 0.7, {(0.0, 0.0)}),
    "cone on its base on box": (TABLE, CONE, UP, 0.5, RIM),
    "cone on its base on plane": (FLOOR, CONE, UP, 0.5, RIM),
    "cone on its base on cylinder": (DISC, CONE, UP, 0.5, RIM),
    "cone on its apex on box": (TABLE, CONE, DOWN, 0.5, {(0.0, 0.0)}),
    "sphere on box": (TABLE, Sphere(0.5), UP, 0.5, {(0.0, 0.0)}),
    "ellipsoid on box": (TABLE, Ellipsoid((0.3, 0.5, 0.4)), UP, 0.5, {(0.0, 0.0)}),
    "ellipsoid on plane": (FLOOR, Ellipsoid((0.3, 0.5, 0.4)), UP, 0.5, {(0.0, 0.0)}),
}


def resting(below: Any, turn: Any, height: float, gap: float = -1e-3, turned: Any = UP) -> Poses:
    """Return the poses of a body on another, whose top is at 0.5 m, both turned."""
    up = quaternion.rotate(turned, np.array([0.0, 1.0, 0.0]))
    return Poses(np.zeros(3), turned, (0.5 + height + gap) * up, quaternion.multiply(turned, turn))


@pytest.mark.parametrize("gap", [-1e-3, 0.0, 1e-3])
@pytest.mark.parametrize("name", RESTING)
def test_what_rests_has_the_points_geometry_asks_for(name: str, gap: float) -> None:
    """Overlapping, touching and apart by 1 mm, in either order: places within OVER_EDGE, depths to 1e-8 m."""
    below, above, turn, height, places = RESTING[name]
    places = places | BETWEEN if places is RIM and gap <= 0.0 else places
    pair = Pair(below, above)
    for swapped, sense in ((False, 1.0), (True, -1.0)):
        points = pair.measure(resting(below, turn, height, gap), 0.01, swapped=swapped)
        found = sorted((float(x), float(z)) for (x, _, z), _, _ in points)
        assert len(found) == len(places)
        for x, z in places:
            assert min(max(abs(x - px), abs(z - pz)) for px, pz in found) < 1.001 * OVER_EDGE
        for (_, y, _), normal, depth in points:
            assert depth == pytest.approx(-gap, abs=1e-8)
            assert y == pytest.approx(0.5 + gap / 2.0, abs=1e-8)
            assert normal == pytest.approx([0.0, sense, 0.0], abs=1e-5)


@pytest.mark.parametrize("below", [TABLE, FLOOR, DISC])
def test_a_cone_on_its_side_has_the_ends_of_its_line(below: Any) -> None:
    """Two points, at the apex and at the rim."""
    height = 0.5 * np.sin(SLOPE)  # of the middle of the axis above the line
    points = Pair(below, CONE).measure(resting(below, ON_ITS_SIDE, height), 0.01)
    assert len(points) == 2
    (ax, _, az), (bx, _, bz) = (place for place, _, _ in points)
    assert np.hypot(ax - bx, az - bz) == pytest.approx(np.hypot(1.0, 0.4), abs=1e-6)
    assert [depth for _, _, depth in points] == [pytest.approx(1e-3, abs=1e-8)] * 2


@pytest.mark.parametrize(("a", "b"), [(CAN, CAN), (CAN, ROD), (ROD, ROD)])
def test_straight_sides_along_each_other_have_two_points(a: Any, b: Any) -> None:
    """Of lying cylinders and capsules, shifted along the axis by 0.3 m: the ends of what is side by side."""
    apart = a.radius + b.radius - 1e-3
    poses = Poses(np.zeros(3), LYING, np.array([0.3, apart, 0.0]), LYING)
    points = Pair(a, b).measure(poses, 0.01)
    assert sorted(round(float(place[0]), 5) for place, _, _ in points) == [-0.2, 0.5]
    assert [depth for _, _, depth in points] == [pytest.approx(1e-3, abs=1e-8)] * 2


@pytest.mark.parametrize(("above", "height"), [(ROD, 0.2), (CAN, 0.4)])
def test_what_lies_along_an_edge_has_two_points(above: Any, height: float) -> None:
    """On the edge of a box or hull that stands on its own edge: the ends of what is side by side, 0.8 m apart."""
    ridge = quaternion.from_axis_angle(np.array([1.0, 0.0, 0.0]), np.pi / 4.0)
    solid = Convex.stated(points=[(x, y, z) for x in (-0.4, 0.4) for y in (-0.4, 0.4) for z in (-0.4, 0.4)])
    poses = Poses(np.zeros(3), ridge, np.array([0.0, 0.4 * np.sqrt(2.0) + height - 1e-3, 0.0]), LYING)
    for below in (CUBE, solid):
        points = Pair(below, above).measure(poses, 0.01)
        assert sorted(round(float(place[0]), 4) for place, _, _ in points) == [-0.4, 0.4]
        assert [depth for _, _, depth in points] == [pytest.approx(1e-3, abs=1e-8)] * 2


def test_a_hull_on_a_cylinder_has_the_corners_of_its_face() -> None:
    """The hull of a cube is measured as the cube is, to OVER_EDGE: its shape goes second, and that face is cut."""
    points = []
    corners = np.array([(x, y, z) for x in (-0.4, 0.4) for y in (-0.4, 0.4) for z in (-0.4, 0.4)])
    solid = Convex.stated(points=corners)
    for pair in (Pair(DISC, CUBE), Pair(DISC, solid)):
        points.append({tuple(np.round(place, 4) + 0.0) for place, _, _ in pair.measure(resting(DISC, UP, 0.4), 0.01)})
    assert points[0] == points[1]


@pytest.mark.parametrize("name", RESTING)
def test_points_keep_their_numbers_while_the_pair_trembles(name: str) -> None:
    """Turned by a tenth of a microradian and moved by a tenth of a micrometre: the same features."""
    below, above, turn, height, _ = RESTING[name]
    pair, generator = Pair(below, above), np.random.default_rng(8)
    if "capsule" in name:
        turn = quaternion.multiply(turn, quaternion.from_axis_angle(np.array([0.0, 1.0, 0.0]), 0.3))
    pair.measure(resting(below, turn, height), 0.01)
    features = pair.features
    assert len(set(features)) == len(features)
    for _ in range(20):
        turned = quaternion.normalise(np.append(5e-8 * generator.normal(size=3), 1.0))
        poses = resting(below, quaternion.multiply(turned, turn), height)
        pair.measure(poses._replace(position_b=poses.position_b + 1e-7 * generator.normal(size=3)), 0.01)
        assert pair.features == features
