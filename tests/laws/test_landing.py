"""Landing: bodies that fall one on the other, without restitution, are not driven into each other."""

from __future__ import annotations

from typing import Any

import pytest

from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.systems.simulation import Simulation

FALLING = (0.0, -3.8, 0.0)  # m/s: as far in a step as six bodies of 1 cm are high


@pytest.mark.parametrize("shape", ["box", "sphere"])
@pytest.mark.parametrize(
    ("size", "count", "most"),
    [(1.0, 5, 0.015), (0.1, 2, 0.01), (0.1, 5, 0.06), (0.01, 2, 0.03)],
)
def test_a_column_that_lands_does_not_sink_into_itself(shape: str, size: float, count: int, most: float) -> None:
    """Its deepest overlap, as a part of its size, is that at which a blow is left to the solver, or a few of those.

    A blow goes on through those who rest until less than 2 % of a radius of gyration is left of it for each pair, which
    is 0.8 % of a cube; what is left of several adds up where they are hit again before it has gone.
    """
    simulation = column(shape, size, count)
    contact, deepest = simulation.world[Contact], 0.0
    for _ in range(40):
        simulation.step()
        deepest = max(deepest, contact.depth[: contact.count].max(initial=0.0))
    assert 0.0 < deepest <= most * size


def test_who_rides_on_a_ball_that_lands_on_one_that_stands_does_not_sink() -> None:
    """What stands has no body, and the ground need not be at the origin."""
    simulation = Simulation(sleeping=False)
    simulation.add(collider={"sphere": {"radius": 1.0}}, transform={"position": (100.0, -1.0, 0.0)})
    for height in (0.06, 0.16):
        place, ball = {"position": (100.0, height, 0.0)}, {"sphere": {"radius": 0.05}}
        simulation.add(transform=place, motion={"linear": FALLING}, body={}, collider=ball)
    contact, deepest = simulation.world[Contact], 0.0
    for _ in range(20):
        simulation.step()
        deepest = max(deepest, contact.depth[: contact.count].max(initial=0.0))
    assert 0.0 < deepest <= 0.001


@pytest.mark.parametrize("shape", ["box", "sphere"])
def test_a_blow_through_a_column_is_one_impact_of_each_pair(shape: str) -> None:
    """However often it goes to and fro at that time: who listens for impacts hears it once."""
    simulation = column(shape, 0.1, 3)
    impact = simulation.world[Impact]
    told: list[tuple[int, int, float]] = []
    for _ in range(3):
        simulation.step()
        rows = slice(0, impact.count)
        told += zip(impact.a[rows].tolist(), impact.b[rows].tolist(), impact.time[rows].tolist(), strict=True)
    assert len(told) == len(set(told)) > 2


def column(shape: str, size: float, count: int) -> Simulation:
    """Return bodies that fall on the ground, each as far above the one below as it is high."""
    simulation = Simulation(sleeping=False)
    simulation.add(collider={"plane": {}})
    collider: dict[str, Any] = {"box": {"size": (size,) * 3}} if shape == "box" else {"sphere": {"radius": 0.5 * size}}
    for k in range(count):
        place = {"position": (0.0, size * (0.6 + 2.0 * k), 0.0)}
        simulation.add(transform=place, motion={"linear": FALLING}, body={}, collider=collider)
    return simulation
