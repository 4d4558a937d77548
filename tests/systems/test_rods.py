"""Rods that lie all but along each other: points at both ends of what is side by side, as far apart as sides are."""

from __future__ import annotations

import numpy as np
import pytest
from pairs import Pair, Poses

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.constants import ASKEW_ROUND
from carom.systems.shapes.box import Box
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.shape import Shape

RADIUS, LENGTH, EDGE, DEEP = 0.3, 1.0, 0.2, 1e-4
ROD, BEAM = Cylinder(RADIUS, LENGTH), Box((LENGTH, EDGE, EDGE))
ALONG_X = quaternion.from_axis_angle((0.0, 0.0, 1.0), -0.5 * np.pi)
ON_EDGE = quaternion.from_axis_angle((1.0, 0.0, 0.0), 0.25 * np.pi)


def laid(lower: Shape, upper: Shape, degrees: float, along: float = 0.0) -> tuple[Floats, Floats]:
    """Return points (n, 3) and depths of one that lies on another along x, moved along and turned, in order of x."""
    turns = [ALONG_X if shape is ROD else ON_EDGE for shape in (lower, upper)]
    high = sum(RADIUS if shape is ROD else EDGE * np.sqrt(0.5) for shape in (lower, upper))
    yaw = quaternion.from_axis_angle((0.0, 1.0, 0.0), np.radians(degrees))
    above = np.array([along, high - DEEP, 0.0])
    points = Pair(lower, upper).measure(Poses(np.zeros(3), turns[0], above, quaternion.multiply(yaw, turns[1])), 0.01)
    points.sort(key=lambda point: float(point[0][0]))
    return np.array([place for place, _, _ in points]), np.array([depth for _, _, depth in points])


@pytest.mark.parametrize("degrees", [0.2, 1.0, 2.0, 5.0])
def test_ends_are_as_far_apart_as_round_sides_are_there(degrees: float) -> None:
    """The axes are d beside each other there, the sides d^2 / (4 r) farther apart than where they cross."""
    place, depth = laid(ROD, ROD, degrees)
    sine = np.sin(np.radians(degrees))
    aside = min(ASKEW_ROUND * 2.0 * RADIUS, 0.5 * LENGTH * sine)
    assert place[[0, -1], 0] == pytest.approx(np.array([-aside, aside]) / sine, rel=5e-3)  # sines are not tangents
    assert depth[[0, -1]] == pytest.approx([DEEP - aside**2 / (4.0 * RADIUS)] * 2, abs=2e-6)
    assert len(depth) == 3
    assert place[1, 1:] == pytest.approx([RADIUS - 0.5 * DEEP, 0.0], abs=1e-5)
    assert abs(place[1, 0]) < 5e-3  # where they cross is known as well as the normal, by the angle between them
    assert depth[1] == pytest.approx(DEEP, abs=1e-7)


def test_the_least_turn_takes_no_point_from_end_to_end() -> None:
    """Two rods half beside each other have the same ends, whether they cross here or there or are along."""
    for degrees in (-0.2, -0.01, 0.0, 0.01, 0.2):
        place, _ = laid(ROD, ROD, degrees, along=0.4)
        assert place[[0, -1], 0] == pytest.approx([-0.1, 0.5], abs=1e-3)


def test_a_rod_on_a_sharp_edge_lies_on_its_side() -> None:
    """Only the rod is round: they part by d^2 / (2 r)."""
    place, depth = laid(BEAM, ROD, 2.0)
    aside = ASKEW_ROUND * RADIUS
    assert place[[0, -1], 0] == pytest.approx(np.array([-aside, aside]) / np.sin(np.radians(2.0)), rel=5e-3)
    assert depth == pytest.approx(DEEP - np.array([1.0, 0.0, 1.0]) * aside**2 / (2.0 * RADIUS), abs=2e-6)
