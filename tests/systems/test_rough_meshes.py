"""Rough meshes: what bears a body on ridges and in valleys is found wherever the least turn or overlap has taken it."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from meshes import LEVEL, LYING, laid

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.shapes.box import Box
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.shape import Shape


def folded(*heights: float, spacing: float = 0.5) -> Geometry:
    """Return land of ridges and valleys along z, 4 m long, at these heights ``spacing`` (m) apart along x."""
    x = spacing * (np.arange(len(heights)) - (len(heights) - 1) / 2.0)
    rims = [np.stack([x, np.array(heights), np.full(len(x), z)], axis=1) for z in (-2.0, 2.0)]
    k, n = np.arange(len(x) - 1), len(x)
    faces = np.concatenate([np.stack([k, k + n, k + 1], 1), np.stack([k + 1, k + n, k + n + 1], 1)])
    return Geometry(np.concatenate(rims), faces, "folded")


@pytest.mark.parametrize("gap", [-2e-3, -7e-4, -1e-4, 0.0, 1e-4, 2e-3])
def test_both_ends_of_a_ridge_within_the_area_bear(gap: float) -> None:
    """Three ridges, the middle one 0.3 mm higher: at both of its ends is a point, however little they overlap."""
    land = laid(folded(0.0, -0.2, 3e-4, -0.2, 0.0, spacing=0.25), Box((1.2, 1.0, 1.0)), 1, turn=LEVEL)
    (found,) = land.measure(np.array([[0.0, 0.5 + 3e-4 + gap, 0.0]]), LEVEL[None], 5e-3)
    middle = np.abs(found.point[:, 0]) < 1e-6
    assert np.sort(found.point[middle, 2]) == pytest.approx([-0.5, 0.5], abs=2e-5)  # OVER_EDGE
    assert found.depth[middle] == pytest.approx([-gap] * 2, abs=1e-9)
    assert set(np.sign(found.point[:, 0]).round().astype(int)) == {-1, 0, 1}


@pytest.mark.parametrize(
    ("shape", "steep"),
    [(Box((1.0, 1.0, 1.0)), 0.3), (Cone(0.5, 1.0), 0.3), (Cone(0.5, 1.0), 1.0)],
    ids=["box", "cone", "cone in a gorge"],
)
@pytest.mark.parametrize("deep", [1e-5, 1e-3, 4e-3, 2e-2, 0.2])
@pytest.mark.parametrize("aside", [-0.9, -0.4, 0.0, 0.4, 0.9])
def test_a_corner_in_the_bottom_of_a_valley_is_borne(shape: Shape, steep: float, deep: float, aside: float) -> None:
    """In it, and sunk in: somewhere beneath the wedge over neither side it is still as deep as the nearer side says."""
    land = laid(folded(2.0 * steep, 0.0, 2.0 * steep, spacing=2.0), shape, 1, turn=LEVEL)
    turn = quaternion.normalise(np.array([0.3, 0.1, 0.25, 1.0]) if isinstance(shape, Box) else np.array([1.0, 0, 0, 0]))
    tip = lowest(shape, turn)
    sine, cosine = steep / np.hypot(1.0, steep), 1.0 / np.hypot(1.0, steep)
    place = np.array([aside * deep * sine, 0.0, 0.3])
    place[1] = steep * abs(place[0]) - deep / cosine  # that deep under the side it is beneath
    (found,) = land.measure((place - tip)[None], turn[None], 1e-4)
    assert len(found.depth)
    assert found.depth.max() == pytest.approx(deep, rel=1e-6)
    assert np.abs(found.point - place).max() < deep


@pytest.mark.parametrize("steep", [0.3, 0.6])
@pytest.mark.parametrize("aside", [-1.5, -1.1, 1.1, 1.5])
def test_a_tip_over_one_side_of_a_valley_is_borne_by_that_alone(steep: float, aside: float) -> None:
    """Where it has sunk in so far that it is beneath the plane of the other side as well, that is not as near."""
    deep, length = 0.1, np.hypot(1.0, steep)
    place = np.array([aside * deep * steep / length, 0.0, 0.3])
    place[1] = steep * abs(place[0]) - deep * length
    assert place[1] + steep * abs(place[0]) < -0.01
    land = laid(folded(2.0 * steep, 0.0, 2.0 * steep, spacing=2.0), Cone(0.5, 1.0), 1, turn=LEVEL)
    (found,) = land.measure((place + np.array([0.0, 0.5, 0.0]))[None], np.array([[1.0, 0.0, 0.0, 0.0]]), 1e-4)
    assert found.depth == pytest.approx([deep], rel=1e-9)


@pytest.mark.parametrize("sides", [3, 4, 6])
@pytest.mark.parametrize("deep", [1e-5, 1e-3, 2e-2, 0.2])
def test_a_tip_beneath_the_bottom_of_a_pit_is_borne_by_all_its_sides(sides: int, deep: float) -> None:
    """There it is over none of them, and as deep beneath each as that one's plane is above it."""
    steep, angles = 1.5, np.arange(sides) * 2.0 * np.pi / sides
    rim = 4.0 * np.stack([np.cos(angles), np.full(sides, steep), np.sin(angles)], axis=1)
    faces = np.array([((k + 1) % sides, k, sides) for k in range(sides)])
    tip = np.array([0.1 * deep, -deep, -0.05 * deep])
    land = laid(Geometry(np.concatenate([rim, np.zeros((1, 3))]), faces, "pit"), Cone(0.2, 1.0), 1, turn=LEVEL)
    upside_down = quaternion.normalise(np.array([1.0, 0.0, 0.0, 0.0]))
    (found,) = land.measure(np.array([[tip[0], tip[1] + 0.5, tip[2]]]), upside_down[None], 1e-6)
    across = np.cross(rim - np.roll(rim, -1, axis=0), -rim)
    beneath = -(across / np.linalg.norm(across, axis=1)[:, None]) @ tip
    deepest = np.sort(beneath)[-4:]  # a body has at most four manifolds with a mesh
    assert np.sort(found.depth) == pytest.approx(deepest, rel=1e-9)


@pytest.mark.parametrize("aside", [-0.015, -0.005, 0.0, 0.005, 0.015])
def test_a_corner_over_one_side_of_a_valley_may_be_over_the_other_the_next_moment(aside: float) -> None:
    """Within reach of both, it is so far from either plane; a flat seam has but one of both."""
    turn = quaternion.normalise(np.array([0.3, 0.1, 0.25, 1.0]))
    tip, high, reach = lowest(Box((1.0, 1.0, 1.0)), turn), 0.01, 0.03
    for steep in (0.3, 0.0):
        land = laid(folded(2.0 * steep, 0.0, 2.0 * steep, spacing=2.0), Box((1.0, 1.0, 1.0)), 1, turn=LEVEL)
        place = np.array([aside, steep * abs(aside) + high, 0.3])
        (found,) = land.measure((place - tip)[None], turn[None], reach)
        gaps = (place[1] - steep * aside * np.array([-1.0, 1.0])) / np.hypot(1.0, steep)
        assert np.sort(-found.depth) == pytest.approx(np.sort(gaps) if steep else [high], abs=1e-12)


def lowest(shape: Shape, turn: Floats) -> Floats:
    """Return the lowest corner of a box or the apex of a cone, from its middle."""
    if not isinstance(shape, Box):
        return quaternion.rotate(turn, np.array([0.0, 0.5, 0.0]))
    corners = quaternion.rotate(turn, np.array(list(itertools.product((-0.5, 0.5), repeat=3))))
    return np.array(corners[np.argmin(corners[:, 1])])


@pytest.mark.parametrize("tilt", [-1e-3, -1e-5, 0.0, 1e-5, 1e-3])
def test_a_cylinder_over_a_triangle_lies_on_all_of_it(tilt: float) -> None:
    """A flat triangle with slopes about it: a cylinder across two of its edges has a point at each, as it may tilt."""
    top = np.array([[-0.3, 0.0, -0.4], [-0.3, 0.0, 0.4], [0.5, 0.0, 0.0]])
    faces = [(0, 1, 2)]
    for k in range(3):
        faces += [((k + 1) % 3, k, 3 + k), ((k + 1) % 3, 3 + k, 3 + (k + 1) % 3)]
    plateau = Geometry(np.concatenate([top, 2.0 * top - [0.0, 0.1, 0.0]]), np.array(faces), "plateau")
    land = laid(plateau, Cylinder(0.3, 1.2), 1, turn=LEVEL)
    turn = quaternion.multiply(quaternion.from_axis_angle((1.0, 0.0, 0.0), tilt), LYING)
    (found,) = land.measure(np.array([[0.0, 0.3, 0.0]]), turn[None], 5e-3)
    order = np.argsort(found.point[:, 2])
    assert found.point[order, 2] == pytest.approx([-0.25, 0.25], abs=2e-4)
    assert found.depth[order] == pytest.approx([-0.25 * tilt, 0.25 * tilt], abs=3e-7)


@pytest.mark.parametrize("degrees", [0.0, 0.05, 0.5])
def test_a_cylinder_all_but_along_a_ridge_has_both_ends(degrees: float) -> None:
    """As far as its side is near: rods that lie along edges do not jump from end to end with the least turn."""
    land = laid(folded(-0.5, 0.0, -0.5), Cylinder(0.3, 1.2), 1, turn=LEVEL)
    turn = quaternion.multiply(quaternion.from_axis_angle((0.0, 1.0, 0.0), np.radians(degrees)), LYING)
    (found,) = land.measure(np.array([[0.0, 0.3, 0.0]]), turn[None], 5e-3)
    aside = 0.6 * np.sin(np.radians(degrees))
    assert [found.point[:, 2].min(), found.point[:, 2].max()] == pytest.approx([-0.6, 0.6], abs=1e-4)
    assert found.depth.min() == pytest.approx(-(aside**2) / (2.0 * 0.3), abs=2e-7)


def test_a_box_over_a_slight_ridge_has_its_corners_on_both_sides() -> None:
    """Level with the one side: the other, all but level, falls away by less than a hair."""
    steep = 1e-3
    land = laid(folded(-2.0 * steep, 0.0, -2.0 * steep, spacing=2.0), Box((1.0, 1.0, 1.0)), 1, turn=LEVEL)
    along, out = np.array([1.0, steep, 0.0]), np.array([-steep, 1.0, 0.0])
    turn = quaternion.from_axis_angle((0.0, 0.0, 1.0), np.arctan(steep))
    (found,) = land.measure((0.5 * out - 0.2 * along)[None], turn[None], 2e-2)
    corners = found.depth[np.abs(np.abs(found.point[:, 0] + 0.2) - 0.5) < 1e-3]
    assert np.sort(corners) == pytest.approx([-0.6 * steep, -0.6 * steep, 0.0, 0.0], abs=2e-6)
