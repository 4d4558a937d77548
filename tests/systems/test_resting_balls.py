"""Balls that rest on each other have a way of their own through the solver: it leads where that of all others does."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform
from carom.systems.kernels.rubbing import BALLS
from carom.systems.resting import Resting
from carom.systems.simulation import Simulation

#: What no ball of its kind does for itself, and changes nothing here: a belt too slow to be seen, and a third axis that
#: nobody moves along.
ELSEWHERE: dict[str, tuple[dict[str, Any], float]] = {"belt": ({}, 1e-290), "plane": ({"dimensions": 2}, 0.0)}


def heap(settings: dict[str, Any], belt: float) -> Simulation:
    """Return forty balls of all sizes and weights over a trough in the plane z = 0."""
    simulation = Simulation(sleeping=False, checked=False, **settings)
    for x in (-1.0, 1.0):
        simulation.add(collider={"plane": {"normal": (x, 1.0, 0.0)}}, material={"friction": 0.6})
    random = np.random.default_rng(3)
    for i in range(40):
        simulation.add(
            collider={"sphere": {"radius": random.uniform(0.2, 0.4)}, "surface_velocity": (belt * i, 0.0, 0.0)},
            body={"mass": random.uniform(0.5, 3.0)},
            material={"friction": random.uniform(0.2, 0.8)},
            transform={"position": (0.8 * (i % 8 - 3.5) + random.uniform(-0.1, 0.1), 4.0 + 0.8 * (i // 8), 0.0)},
        )
    return simulation


def asked(simulation: Simulation) -> set[int]:
    """Return what groups ask for."""
    resting = simulation.world[Resting]
    return set(resting.asks[: resting.groups].tolist())


@pytest.mark.parametrize("way", ELSEWHERE)
def test_balls_go_where_the_way_of_all_others_leads_them(way: str) -> None:
    """Forty in a heap, which rub, roll and slide: the same to rounding, grown by a second and a half of collisions."""
    own, other = heap({}, 0.0), heap(*ELSEWHERE[way])
    ways: list[set[int]] = [set(), set()]
    for _ in range(90):
        for simulation, seen in zip((own, other), ways, strict=True):
            simulation.step()
            seen |= asked(simulation)
    assert BALLS in ways[0]
    assert BALLS not in ways[1]
    for kind, column in ((Transform, "position"), (Motion, "linear"), (Motion, "angular")):
        one, two = (getattr(world[kind], column)[world.rows(RigidBody)] for world in (own.world, other.world))
        np.testing.assert_allclose(one, two, rtol=0.0, atol=1e-7)
