"""Ridges of land under a body: both ends bear it, also where it lies in a hollow, and edges all but along them."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import ColliderPose
from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.detection.narrow import measure_pairs
from carom.systems.shapes.height_field import HeightField
from carom.systems.simulation import Simulation

ACROSS = [0.05, 0.0, -0.01, 0.003, -0.01, 0.0, 0.05]  # m, every 15 cm: a ridge in a hollow
BOX = {"box": {"size": (0.58, 0.2, 0.8)}}
HULL = {"convex": {"points": [(x, y, z) for x in (-0.29, 0.29) for y in (-0.1, 0.1) for z in (-0.4, 0.4)]}}


def on_ridge(shape: object, turn: Floats, spacing: float) -> tuple[Floats, Floats]:
    """Return the points (n, 3) and depths of a body that lies with its face 3 mm beneath a ridge of such pieces (m)."""
    simulation = Simulation()
    land = HeightField.stated(heights=[ACROSS] * (2 + int(0.8 / spacing)), spacing=(0.15, spacing))
    simulation.add(collider={"shape": land})
    simulation.add(collider=shape, body={}, transform={"position": (0.0, 5.0, 0.0)})
    simulation.step()
    with simulation.world.edit(ColliderPose) as pose:
        pose.position[1], pose.rotation[1] = (0.0, 0.1, 0.0), turn
    with simulation.world.faces(None):
        found = measure_pairs(simulation.world, np.array([(0, 1)]), np.array([0.003]))
    return found.point, found.depth


@pytest.mark.parametrize("degrees", [0.0, 0.05, -0.05, 2.0])
@pytest.mark.parametrize("shape", [BOX, HULL], ids=["box", "hull"])
def test_both_ends_of_a_ridge_bear_what_lies_across_it(shape: object, degrees: float) -> None:
    """Though the corners of the body span a larger area, in which they lie; turned a little it is no other one."""
    bears_at_both_ends(shape, quaternion.from_axis_angle((0.0, 1.0, 0.0), np.radians(degrees)), spacing=0.15)


@pytest.mark.parametrize("degrees", [0.01, -0.01])
@pytest.mark.parametrize("shape", [BOX, HULL], ids=["box", "hull"])
def test_both_ends_bear_whichever_is_lower_by_a_hair(shape: object, degrees: float) -> None:
    """Then an edge of the body crosses the ridge at the lower end, all but level with the face."""
    bears_at_both_ends(shape, quaternion.from_axis_angle((1.0, 0.0, 0.0), np.radians(degrees)), spacing=1.0)


def bears_at_both_ends(shape: object, turn: Floats, spacing: float) -> None:
    """Assert that a body has deep points at both ends of the ridge, and beside it none."""
    point, depth = on_ridge(shape, turn, spacing)
    deep = point[depth > 0.002]
    assert (np.abs(deep[:, 0]) < 0.02).all()
    assert deep[:, 2].min() == pytest.approx(-0.4, abs=2e-3)
    assert deep[:, 2].max() == pytest.approx(0.4, abs=2e-3)
