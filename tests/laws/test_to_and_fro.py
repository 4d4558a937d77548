"""Who flies to and fro between two walls, several times in a substep, stays between them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation

BETWEEN, STEPS = 0.5, 12  # m
CAPSULE, COIN = {"capsule": {"radius": 0.02, "length": 0.2}}, {"cylinder": {"radius": 0.12, "length": 0.03}}


@pytest.mark.parametrize("collider", [CAPSULE, COIN], ids=["capsule", "coin"])
@pytest.mark.parametrize("seed", range(30))
def test_who_flies_to_and_fro_stays_between_the_walls(collider: dict[str, Any], seed: int) -> None:
    """At 150 m/s, tumbling: whom it was to meet when it was looked at last is not whom it meets once it is struck."""
    random, simulation = np.random.default_rng(seed), Simulation(gravity=(0.0, 0.0, 0.0), checked=False)
    material = {"restitution": 1.0, "friction": 0.0}
    for x in (-0.5 * BETWEEN - 0.01, 0.5 * BETWEEN + 0.01):
        wall = {"box": {"size": (0.02, 30.0, 30.0)}}
        simulation.add(collider=wall, transform={"position": (x, 0.0, 0.0)}, material=material)
    turned = quaternion.normalise(random.normal(size=4))
    body = simulation.add(
        collider=collider, body={"mass": 1.0}, material=material,
        transform={"position": (random.uniform(-0.05, 0.05), 0.0, 0.0), "rotation": turned},
        motion={"linear": (150.0, 0.0, 0.0), "angular": 60.0 * random.normal(size=3)},
    )  # fmt: skip
    for _ in range(STEPS):
        simulation.step()
        assert abs(simulation[body].transform.position[0]) < 0.5 * BETWEEN
