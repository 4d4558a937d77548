"""On rough land bodies of all shapes come to rest, as pointed and hollow as it may be, and fall asleep."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform
from carom.systems.simulation import Simulation

POINTS = np.random.default_rng(1).normal(size=(12, 3))
ROUND = {"rolling_friction": 0.02, "spinning_friction": 0.02}
#: Shapes, materials, and how many of two hundred may still rock, over three supports almost in a line.
BODIES: dict[str, tuple[dict[str, Any], dict[str, float], int]] = {
    "boxes": ({"box": {"size": (0.9, 0.7, 0.8)}}, {}, 2),
    "hulls": ({"convex": {"points": 0.5 * POINTS / np.linalg.norm(POINTS, axis=1)[:, None]}}, {}, 1),
    "cones": ({"cone": {"radius": 0.45, "length": 0.9}}, ROUND, 0),
    "capsules": ({"capsule": {"radius": 0.35, "length": 0.4}}, ROUND, 0),
    "ellipsoids": ({"ellipsoid": {"radii": (0.5, 0.35, 0.4)}}, ROUND, 0),
}


@pytest.mark.parametrize("bodies", BODIES)
def test_bodies_fall_asleep_on_rough_land(bodies: str) -> None:
    """A hundred of each fall 2 m onto squares of 1 m, of heights up to 0.1 and to 0.6 m, and have 30 s."""
    shape, material, most = BODIES[bodies]
    rocking = 0
    for rough in (0.1, 0.6):
        simulation, random = Simulation(checked=False, sleeping=True), np.random.default_rng(6)
        heights = random.uniform(0.0, rough, (30, 30))
        simulation.add(collider={"height_field": {"heights": heights, "spacing": 1.0}}, material=material)
        for k in range(100):
            turn = random.normal(size=4)
            simulation.add(
                collider=shape, body={}, material=material,
                transform={
                    "position": (2.0 * (k % 10) - 9.0, 2.0, 2.0 * (k // 10) - 9.0),
                    "rotation": tuple(turn / np.linalg.norm(turn)),
                },
            )  # fmt: skip
        simulation.step(1800)
        rows = simulation.world.row_numbers(RigidBody)
        assert (simulation.world[Transform].position[rows, 1] > 0.1).all()
        rocking += int((~simulation.world[Motion].asleep[rows]).sum())
    assert rocking <= most


def test_large_boxes_fall_asleep_on_small_bumps() -> None:
    """Boxes of 3 m on squares of 0.3 m, of heights up to 1 cm: among a hundred bumps those that bear are found."""
    simulation, random = Simulation(checked=False, sleeping=True), np.random.default_rng(1)
    simulation.add(
        collider={"height_field": {"heights": random.uniform(0.0, 0.01, (80, 80)), "spacing": 0.3}},
        material={"friction": 0.6},
    )
    for k in range(10):
        simulation.add(
            collider={"box": {"size": (3.0, 0.5, 3.0)}}, body={"mass": 1.0},
            transform={"position": (4.2 * (k % 5) - 8.4, 0.31, 5.0 * (k // 5) - 2.5)},
        )  # fmt: skip
    simulation.step(300)
    rows = simulation.world.row_numbers(RigidBody)
    assert simulation.world[Motion].asleep[rows].all()
