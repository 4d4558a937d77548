"""Piles of all shapes come to rest and fall asleep, and stay so."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform
from carom.systems.simulation import Simulation

ROCK = np.random.default_rng(1).normal(size=(12, 3))
ROUND = {"rolling_friction": 0.02, "spinning_friction": 0.02}
PILES: dict[str, tuple[list[dict[str, Any]], dict[str, float]]] = {
    "boxes": ([{"box": {"size": (0.6, 0.5, 0.4)}}], {}),
    "cylinders": ([{"cylinder": {"radius": 0.3, "length": 0.5}}], ROUND),
    "hulls": ([{"convex": {"points": 0.35 * ROCK / np.linalg.norm(ROCK, axis=1)[:, None]}}], {}),
    "balls": ([{"sphere": {"radius": 0.25}}], {}),
    "capsules": ([{"capsule": {"radius": 0.2, "length": 0.5}}], ROUND),
    "cones": ([{"cone": {"radius": 0.3, "length": 0.6}}], ROUND),
    "ellipsoids": ([{"ellipsoid": {"radii": (0.3, 0.2, 0.25)}}], ROUND),
}
PILES["all"] = [shape for shapes, _ in PILES.values() for shape in shapes], ROUND


@pytest.mark.parametrize("pile", PILES)
def test_a_pile_falls_asleep_as_a_whole_and_stays_so(pile: str) -> None:
    """A hundred bodies above a bin, 20 s; what is round is slowed as it rolls: else one that rocks keeps all awake."""
    shapes, material = PILES[pile]
    simulation, random = Simulation(checked=False, sleeping=True), np.random.default_rng(7)
    simulation.add(collider={"plane": {}})
    for x, z in ((2.5, 0.0), (-2.5, 0.0), (0.0, 2.5), (0.0, -2.5)):
        size = (1.0, 20.0, 6.0) if x else (6.0, 20.0, 1.0)
        simulation.add(collider={"box": {"size": size}}, transform={"position": (x, 10.0, z)})
    for k in range(100):
        turn = random.normal(size=4)
        simulation.add(
            collider=shapes[k % len(shapes)], body={}, material=material,
            transform={
                "position": (0.75 * (k % 5 - 2), 0.6 + 0.8 * (k // 25), 0.75 * (k // 5 % 5 - 2)),
                "rotation": tuple(turn / np.linalg.norm(turn)),
            },
        )  # fmt: skip
    simulation.step(1200)
    rows = simulation.world.row_numbers(RigidBody)
    motion, position = simulation.world[Motion], simulation.world[Transform].position
    assert motion.asleep[rows].all()
    before = position[rows].copy()
    simulation.step(60)
    assert motion.asleep[rows].all()
    assert np.array_equal(position[rows], before)
    assert (position[rows, 1] > 0.05).all()
    assert (np.abs(position[rows][:, [0, 2]]) < 2.0).all()
