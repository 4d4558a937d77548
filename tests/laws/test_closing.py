"""Who is told that he cannot strike within a substep does not."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Collider, RigidBody, Transform
from carom.ecs.relations.impact import Impact
from carom.systems.kernels.closing import CANNOT, MAY
from carom.systems.resting import Resting
from carom.systems.simulation import Simulation

COUNT, STEPS = 60, 360  # of a single substep, in the last of which an overlap shows
DEEPEST = 1e-9  # m


def crowd(gravity: float) -> Simulation:
    """Return balls of three sizes that fly to and fro between walls, boxes and half spaces, and lose nothing."""
    generator = np.random.default_rng(11)
    simulation = Simulation(gravity=(0.0, -gravity, 0.0), dt=1.0 / 240.0, substeps=1, sleeping=False, checked=False)
    whole = {"restitution": 1.0, "friction": 0.3}
    for axis in range(3):
        for side in (-1.0, 1.0):
            normal, size, place = np.zeros(3), np.full(3, 6.0), np.zeros(3)
            normal[axis], place[axis] = -side, side * 2.0
            if axis < 2:
                size[axis], place[axis] = 1.0, side * 2.5
                simulation.add(collider={"box": {"size": size}}, transform={"position": place}, material=whole)
            else:
                simulation.add(collider={"plane": {"normal": normal}}, transform={"position": place}, material=whole)
    for k in range(COUNT):
        place = np.array([k % 4, k // 4 % 4, k // 16]) - 1.5
        simulation.add(
            collider={"sphere": {"radius": 0.2 + 0.1 * (k % 3)}}, body={"mass": 1.0}, material=whole,
            transform={"position": place},
            motion={"linear": generator.normal(size=3), "angular": generator.normal(size=3)},
        )  # fmt: skip
    return simulation


@pytest.mark.parametrize("gravity", [0.0, 9.81])
def test_who_cannot_strike_does_not(gravity: float) -> None:
    """Most are told so, and some that close, or are near and part: who were told wrongly would overlap."""
    simulation, struck, numbers = crowd(gravity), 0, np.zeros(2, np.int64)
    world = simulation.world
    rows = world.row_numbers(RigidBody)
    radii = world[Collider].size[rows, 0]
    apart = radii[:, None] + radii + np.diag(np.full(COUNT, -np.inf))
    for _ in range(STEPS):
        simulation.step()
        places = world[Transform].position[rows]
        gaps = np.linalg.norm(places[:, None] - places, axis=2) - apart
        assert gaps.min() > -DEEPEST
        assert (2.0 - radii[:, None] - np.abs(places)).min() > -DEEPEST
        closes = world[Resting].closes[: world[Resting].count]
        numbers += (closes == CANNOT).sum(), (closes == MAY).sum()
        struck += world[Impact].count
    assert struck > STEPS / 2
    assert numbers[0] > 5 * numbers[1] > 0
