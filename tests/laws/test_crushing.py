"""What is crushed between what drives it and what stands is not thrown out."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform
from carom.systems.simulation import Simulation

FASTEST = 40.0  # m/s


def in_a_press(seed: int) -> Simulation:
    """Return a bin of boxes and balls, and a plate above them that comes down at 1 m/s, whatever is in its way."""
    simulation, random = Simulation(dt=1 / 60, sleeping=False), np.random.default_rng(seed)
    simulation.add(collider={"plane": {}})
    for x, z in ((3, 0), (-3, 0), (0, 3), (0, -3)):
        wall = {"box": {"size": (1.0 if x else 7.0, 8.0, 1.0 if z else 7.0)}}
        simulation.add(collider=wall, transform={"position": (x, 4.0, z)})
    for k in range(100):
        collider = {"box": {"size": (0.6, 0.6, 0.6)}} if k % 2 else {"sphere": {"radius": 0.35}}
        x, z = random.uniform(-2.0, 2.0, 2)
        simulation.add(collider=collider, body={}, transform={"position": (x, 0.5 + 0.08 * k, z)})
    simulation.step(120)
    simulation.add(
        collider={"box": {"size": (4.9, 1.0, 4.9)}}, body={"type": "kinematic"},
        transform={"position": (0.0, 3.0, 0.0)}, motion={"linear": (0.0, -1.0, 0.0)},
    )  # fmt: skip
    return simulation


@pytest.mark.parametrize("seed", range(3))
def test_what_a_press_crushes_stays_in_it(seed: int) -> None:
    """The plate ends in the floor, so that all overlap wholly; impulses that add up made 400 to 1,200 m/s of that."""
    simulation, fastest = in_a_press(seed), 0.0
    world = simulation.world
    rows = world.row_numbers(RigidBody)
    rows = rows[world[RigidBody].inverse_mass[rows] > 0.0]
    for _ in range(180):
        simulation.step()
        fastest = max(fastest, float(np.linalg.norm(world[Motion].linear[rows], axis=1).max()))
    assert fastest < FASTEST
    assert np.abs(world[Transform].position[rows]).max() < 9.0
