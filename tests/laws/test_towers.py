"""Towers of blocks that touch at more than four points, or with several colliders, come to rest as others do."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation

HIGH = 0.6
CORNERS = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.3, 0.3) for z in (-0.5, 0.5)]
RING = np.arange(8) * np.pi / 4
BLOCKS: dict[str, Any] = {
    "box": {"box": {"size": (1.0, HIGH, 1.0)}},
    "hull": {"convex": {"points": CORNERS}},
    "octagon": {"convex": {"points": [(0.5 * np.cos(a), y, 0.5 * np.sin(a)) for a in RING for y in (-0.3, 0.3)]}},
    "drum": {"cylinder": {"radius": 0.5, "length": HIGH}},
}


def fastest(simulation: Simulation) -> float:
    """Return the greatest speed of any body, half a metre from its middle."""
    rows, motion = simulation.world.row_numbers(RigidBody), simulation.world[Motion]
    speeds = [np.linalg.norm(motion.linear[rows], axis=1), 0.5 * np.linalg.norm(motion.angular[rows], axis=1)]
    return float(np.sum(speeds, axis=0).max())


@pytest.mark.parametrize("degrees", [0.0, 7.0, 45.0])
@pytest.mark.parametrize("block", BLOCKS)
def test_a_tower_of_turned_blocks_does_not_sway(block: str, degrees: float) -> None:
    """Eight blocks, each turned against the one below: after 8 s slower than 1 um/s, and where it was to 2 mm."""
    simulation = tower(block, 8, degrees)
    assert fastest(simulation) <= 1e-6
    rows = simulation.world.row_numbers(RigidBody)
    assert np.abs(simulation.world[Transform].position[rows][:, [0, 2]]).max() <= 2e-3


def test_a_higher_tower_rests_as_soon_since_each_manifold_spans_the_area() -> None:
    """Twelve hulls, 8 s: were the eight points of each two parted into halves of the area, it were 0.2 mm/s."""
    assert fastest(tower("hull", 12, 7.0)) <= 3e-5


def tower(block: str, high: int, degrees: float) -> Simulation:
    """Return a tower of blocks after 8 s, each turned against the one below."""
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    for k in range(high):
        turn = quaternion.from_axis_angle((0.0, 1.0, 0.0), np.radians(degrees * k))
        place = {"position": (0.0, HIGH * (k + 0.5), 0.0), "rotation": turn}
        simulation.add(collider=BLOCKS[block], body={}, transform=place)
    simulation.step(480)
    return simulation


def test_tables_stand_on_tables() -> None:
    """Six of them, on four legs each: each pair has sixteen points in four places."""
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    for k in range(6):
        top = {"position": (0.0, 0.75 + 0.8 * k, 0.0)}
        table = simulation.add(collider={"box": {"size": (1.2, 0.1, 1.2)}}, body={"mass": 10.0}, transform=top)
        for x in (-0.5, 0.5):
            for z in (-0.5, 0.5):
                leg = {"entity": table, "position": (x, -0.4, z)}
                simulation.add(collider={"box": {"size": (0.1, 0.7, 0.1)}}, parent=leg)
    simulation.step(600)
    assert fastest(simulation) <= 1e-5
    rows = simulation.world.row_numbers(RigidBody)
    assert np.abs(simulation.world[Transform].position[rows][:, [0, 2]]).max() <= 1e-3
