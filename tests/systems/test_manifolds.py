"""Manifolds are those that geometry asks for: corners, edges, faces and lines, each with its points."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from narrow_pairs import LEVEL, lone

from carom.ecs.spatial import quaternion
from carom.systems.shapes import Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.plane import Plane


def rounded(points: Any) -> set[tuple[float, ...]]:
    """Return points as a set, to 10 micrometres."""
    return {tuple(point) for point in (np.round(points, 5) + 0.0).tolist()}


def about(axis: tuple[float, float, float], degrees: float) -> Any:
    """Return a rotation."""
    return quaternion.from_axis_angle(np.array(axis), np.radians(degrees))


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
CUBE = Box((1.0, 1.0, 1.0))


@pytest.mark.parametrize("gap", [-0.01, 0.0, 0.01])
def test_a_box_on_a_box_touches_at_the_corners_of_the_overlap(gap: float) -> None:
    """Two cubes shifted sideways share a rectangle; turned by 45 degrees an octagon, of which four stay if apart."""
    answer = lone(CUBE, CUBE, (0.2, 1.0 + gap, 0.3), reach=0.02)
    middle = 0.5 + 0.5 * gap
    assert rounded(answer.point) == {(x, round(middle, 5), z) for x in (-0.3, 0.5) for z in (-0.2, 0.5)}
    assert answer.depth == pytest.approx(np.full(4, -gap), abs=1e-12)
    assert answer.normal == pytest.approx(np.tile(Y, (4, 1)), abs=1e-12)
    answer = lone(CUBE, CUBE, (0.0, 1.0 + gap, 0.0), rotation_b=about(Y, 45.0), reach=0.02)
    assert answer.count == [4 if gap > 0.0 else 8]
    width = np.sqrt(((answer.point[:, None] - answer.point[None]) ** 2).sum(axis=2))
    assert width.max() > 1.08  # across the octagon, whose inner circle is 1 m wide


def test_crossed_planks_touch_where_they_cross() -> None:
    """Neither has a corner over the other: the four points are where edges cross, nearly level or not."""
    plank = Box((3.0, 0.1, 0.2))
    for tilt in (0.0, 0.1):
        turned = quaternion.multiply(about(Y, 90.0), about(X, tilt))
        answer = lone(plank, plank, (0.0, 0.1, 0.0), rotation_b=turned, reach=0.01)
        assert answer.count == [4]
        assert rounded(np.round(answer.point[:, ::2], 2)) == {(x, z) for x in (-0.1, 0.1) for z in (-0.1, 0.1)}


def test_edges_touch_at_one_point() -> None:
    """Two cubes on edge, crossed: the gap, the normal and the middle are those of the two edges."""
    half = np.sqrt(0.5)
    for gap in (-0.01, 0.01):
        answer = lone(CUBE, CUBE, (0.1, 2.0 * half + gap, 0.2), about(X, 45.0), about(Z, 45.0), reach=0.02)
        assert answer.depth == pytest.approx([-gap], abs=1e-12)
        assert answer.normal == pytest.approx(np.array([Y]), abs=1e-12)
        assert answer.point == pytest.approx(np.array([[0.1, half + 0.5 * gap, 0.0]]), abs=1e-12)


def test_corners_apart_are_as_far_as_they_are() -> None:
    """The gap of two cubes corner to corner is that of the corners, though every axis sees less."""
    way = np.array([0.01, 0.02, 0.02])
    answer = lone(CUBE, CUBE, 1.0 + way, reach=0.05)
    assert answer.depth == pytest.approx([-0.03], abs=1e-12)
    assert answer.normal == pytest.approx(way[None] / 0.03, abs=1e-9)
    assert answer.point == pytest.approx(0.5 + 0.5 * way[None], abs=1e-12)
    assert lone(CUBE, CUBE, 1.0 + way, reach=0.025).count == [0]


@pytest.mark.parametrize(("turned", "corners"), [(LEVEL, 4), (about(X, 45.0), 2), (about(X, 30.0), 2)])
def test_a_box_on_a_plane_stands_on_its_corners(turned: Any, corners: int) -> None:
    """A face gives four, an edge two, each with its own depth."""
    floor = Plane((0.0, 1.0, 0.0), 0.0)
    low = 0.5 if corners == 4 else 0.5 * (np.cos(np.pi / 4) + np.sin(np.pi / 4))
    if turned is not LEVEL and corners == 2:
        local = quaternion.rotate(quaternion.conjugate(turned), np.array(Y))
        low = 0.5 * np.abs(local).sum()
    answer = lone(CUBE, floor, (0.0, 0.01 - low, 0.0), rotation_a=turned)
    assert answer.depth == pytest.approx(np.full(corners, 0.01), abs=1e-12)
    assert answer.normal == pytest.approx(np.tile((0.0, -1.0, 0.0), (corners, 1)), abs=1e-12)
    assert answer.point[:, 1] == pytest.approx(np.full(corners, 0.005 - low), abs=1e-12)


@pytest.mark.parametrize(
    ("shift", "turned", "ends"),
    [
        (0.0, about(Z, 90.0), {-0.5, 0.5}),
        (0.7, about(Z, 90.0), {0.2, 1.0}),
        (0.0, LEVEL, {0.0}),
        (0.0, about(Z, 60.0), {0.5 * np.cos(np.radians(30.0))}),
    ],
)
def test_a_capsule_on_a_box(shift: float, turned: Any, ends: set[float]) -> None:
    """Lying, it has a point at each end of what lies over the face; standing or leaning one, under its lower end."""
    capsule, slab = Capsule(0.1, 1.0), Box((2.0, 1.0, 2.0))
    lowest = 0.5 * abs(quaternion.rotate(turned, np.array(Y))[1])
    at = np.array([shift, 0.6 + lowest - 0.01, 0.0])
    answer = lone(capsule, slab, -at, turned, LEVEL, reach=0.005)
    assert rounded(answer.point[:, :1] + shift) == {(round(min(end, 1.0), 5),) for end in ends}
    assert answer.depth == pytest.approx(np.full(len(ends), 0.01), abs=1e-9)
    assert answer.normal == pytest.approx(np.tile((0.0, -1.0, 0.0), (len(ends), 1)), abs=1e-9)


WAY = (0.6, 0.8, 0.0)  # out of an edge along z


@pytest.mark.parametrize(
    ("axis", "degrees", "points"),
    [(WAY, 0.0, 2), (WAY, 2.0, 1), ((-0.8, 0.6, 0.0), 0.01, 2), ((-0.8, 0.6, 0.0), 8.0, 1)],
)
def test_a_capsule_along_an_edge_has_two_points(axis: tuple[float, float, float], degrees: float, points: int) -> None:
    """The way out is from the edge, not from a face; one that crosses the edge, or stands up from it, has one point."""
    turned = quaternion.multiply(about(axis, degrees), about(X, 90.0))
    away = np.array([0.5, 0.5, 0.2]) + (0.09 + 0.5 * np.sin(np.radians(degrees)) * (axis != WAY)) * np.array(WAY)
    answer = lone(Capsule(0.1, 1.0), CUBE, -away, turned, reach=0.02)
    assert answer.count == [points]
    assert answer.depth.max() == pytest.approx(0.01, abs=1e-4)
    assert answer.normal == pytest.approx(np.tile(-np.array(WAY), (points, 1)), abs=1e-3)
    if points == 2:
        assert rounded(np.round(answer.point[:, 2:] + 0.2, 3)) == {(-0.3,), (0.5,)}
        assert len(set(answer.feature.tolist())) == 2


def test_parallel_capsules_have_two_points() -> None:
    """Two logs touch at the ends of what lies side by side; crossed ones where they cross; in a row at the caps."""
    log = Capsule(0.25, 1.0)
    answer = lone(log, log, (0.49, 0.4, 0.0))
    assert rounded(answer.point) == {(0.245, -0.1, 0.0), (0.245, 0.5, 0.0)}
    assert answer.depth == pytest.approx([0.01, 0.01], abs=1e-12)
    assert sorted(answer.feature.tolist()) == [0, 1]
    answer = lone(log, log, (0.49, 0.4, 0.1), rotation_b=about(X, 90.0))
    assert answer.point == pytest.approx(np.array([[0.245, 0.4, 0.0]]), abs=1e-12)
    answer = lone(log, log, (0.0, 1.49, 0.0))
    assert answer.depth == pytest.approx([0.01], abs=1e-12)
    assert answer.normal == pytest.approx(np.array([Y]), abs=1e-12)


@pytest.mark.parametrize(
    ("a", "b", "at", "turned", "count"),
    [
        (CUBE, CUBE, (0.0, 1.0, 0.0), LEVEL, 4),
        (CUBE, CUBE, (0.2, 1.0, 0.1), about(Y, 20.0), 5),
        (Box((5.0, 1.0, 5.0)), CUBE, (0.0, 1.0, 0.0), LEVEL, 4),
        (CUBE, Plane((0.0, -1.0, 0.0), -0.5), (0.0, 0.0, 0.0), LEVEL, 4),
        (Capsule(0.5, 1.0), CUBE, (1.0, 0.0, 0.0), LEVEL, 2),
        (Capsule(0.5, 1.0), Capsule(0.5, 1.0), (1.0, 0.0, 0.0), LEVEL, 2),
    ],
)
def test_features_stay_while_the_pair_moves_little(a: Shape, b: Shape, at: Any, turned: Any, count: int) -> None:
    """What rests and trembles by a tenth of a micrometre keeps the numbers of its points, so that warm starts hold."""
    generator = np.random.default_rng(5)
    seen = set()
    for _ in range(100):
        tremble = quaternion.normalise(turned + 1e-7 * generator.normal(size=4))
        place = np.array(at) + 1e-7 * generator.normal(size=3)
        answer = lone(a, b, place, LEVEL, tremble, reach=0.01)
        seen.add(tuple(sorted(answer.feature.tolist())))
    assert len(seen) == 1
    assert len(seen.pop()) == count


@pytest.mark.parametrize("degrees", [0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("gap", [0.01, -0.005])
def test_a_box_tilted_about_two_axes_has_four_points(degrees: float, gap: float) -> None:
    """Two edges part it from the face below, whose other corners are about to land: they are known in time.

    The deepest is where the edges cross; each corner of the tilted face that is over the other one keeps its height.
    """
    tilt = quaternion.from_axis_angle((np.sqrt(0.5), 0.0, np.sqrt(0.5)), np.radians(degrees))
    corners = np.array([(x, -0.5, z) for x in (-0.5, 0.5) for z in (-0.5, 0.5)])
    low = quaternion.rotate(np.tile(tilt, (4, 1)), corners)
    at = np.array([0.03, 0.5 - low[:, 1].min() + gap, 0.02])
    answer = lone(CUBE, CUBE, at, LEVEL, tilt, reach=0.2)
    assert answer.count.tolist() == [4]
    heights = np.sort(low[:, 1] + at[1] - 0.5)
    assert -answer.depth.max() == pytest.approx(heights[0], abs=0.05 * np.radians(degrees))
    assert (-answer.depth <= heights[-1] + 1e-9).all()
    assert (answer.normal[:, 1] > 0.995).all()
    assert np.ptp(answer.normal, axis=0).max() == 0.0
