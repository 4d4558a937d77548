"""Crowds of fast bodies pass through nobody either, and how often they are detected hangs on how far they come."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import RigidBody, Transform, state_hash
from carom.systems.constants import TRUST
from carom.systems.detection.answered import Answered
from carom.systems.simulation import Simulation

SPEED, DT = 60.0, 1.0 / 60.0
CUBE, PILL = {"box": {"size": (0.3, 0.3, 0.3)}}, {"capsule": {"radius": 0.05, "length": 0.3}}


def thrown(collider: dict[str, Any], side: int) -> Simulation:
    """Return a block of bodies that fly at a wall of 2 cm, each turning another way."""
    simulation, random = Simulation(gravity=(0.0, 0.0, 0.0), dt=DT), np.random.default_rng(1)
    simulation.add(collider={"box": {"size": (0.02, 20.0, 20.0)}})
    for i, j, k in np.ndindex(side, side, side):
        simulation.add(
            collider=collider, body={}, transform={"position": (-1.0 - 0.54 * i, 0.54 * j, 0.54 * k)},
            motion={"linear": (SPEED, 0.0, 0.0), "angular": 3.0 * random.normal(size=3)},
        )  # fmt: skip
    return simulation


@pytest.mark.parametrize(("collider", "half"), [(CUBE, 0.15), (PILL, 0.05)], ids=["box", "capsule"])
@pytest.mark.parametrize("side", [3, 5])
def test_a_crowd_does_not_pass_a_thin_wall(side: int, collider: dict[str, Any], half: float) -> None:
    """And nobody of it is given up, although many strike in one step and turn away from there, each at its own time.

    Who comes and goes is looked at whenever it has come as far as its contacts are trusted, and all are at once.
    """
    simulation, most = thrown(collider, side), 0
    answered = simulation.world[Answered]
    for _ in range(20):
        before = answered.detections
        simulation.step()
        most = max(most, answered.detections - before)
    places = simulation.world[Transform].position[simulation.world.row_numbers(RigidBody)]
    assert places[:, 0].max() < 0.0
    assert answered.looks_cut == 0
    assert most <= 2.0 * SPEED * DT / (TRUST * half)


def test_a_crowd_goes_the_same_way_whether_somebody_looks_on_or_not() -> None:
    """What is left of the trust in contacts is the same where substeps are taken at once."""
    alone, seen = thrown(CUBE, 3), thrown(CUBE, 3)
    alone.checked = seen.checked = False
    seen.hearers.append(lambda system: None)
    for _ in range(20):
        alone.step()
        seen.step()
        assert state_hash(alone.world) == state_hash(seen.world)
