"""Crowds of fast bodies pass through nobody either, and how often they are detected hangs on how far they come."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from onlookers import looked_on

from carom.ecs import Collider, Transform, restore_snapshot, state_hash, take_snapshot
from carom.systems.constants import MOST_LOOKS, TRUST
from carom.systems.detection.answered import Answered
from carom.systems.simulation import Simulation

SPEED, DT = 60.0, 1.0 / 60.0
CUBE, PILL = {"box": {"size": (0.3, 0.3, 0.3)}}, {"capsule": {"radius": 0.05, "length": 0.3}}
BALL = {"sphere": {"radius": 0.15}}


def thrown(collider: dict[str, Any], side: int, *, comes: bool = False) -> Simulation:
    """Return a block of bodies that fly at a wall of 2 cm, each turning another way; or are at rest, and it comes."""
    simulation, random = Simulation(gravity=(0.0, 0.0, 0.0), dt=DT), np.random.default_rng(1)
    wall: dict[str, Any] = {"body": {"type": "kinematic"}, "motion": {"linear": (-SPEED, 0.0, 0.0)}} if comes else {}
    simulation.add(collider={"box": {"size": (0.02, 20.0, 20.0)}}, **wall)
    for i, j, k in np.ndindex(side, side, side):
        simulation.add(
            collider=collider, body={}, transform={"position": (-1.0 - 0.54 * i, 0.54 * j, 0.54 * k)},
            motion={"linear": (0.0 if comes else SPEED, 0.0, 0.0), "angular": 3.0 * random.normal(size=3)},
        )  # fmt: skip
    return simulation


@pytest.mark.parametrize(("collider", "half"), [(CUBE, 0.15), (PILL, 0.05)], ids=["box", "capsule"])
@pytest.mark.parametrize(("side", "comes"), [(3, False), (5, False), (5, True)])
def test_a_crowd_does_not_pass_a_thin_wall(side: int, comes: bool, collider: dict[str, Any], half: float) -> None:
    """Nor a wall that comes a crowd; and nobody is given up, although many strike in one step and turn away from there.

    Who comes and goes is looked at whenever it has come as far as its contacts are trusted, and all are at once.
    """
    simulation, most = thrown(collider, side, comes=comes), 0
    answered = simulation.world[Answered]
    for _ in range(20):
        before = answered.detections
        simulation.step()
        most = max(most, answered.detections - before)
    places = simulation.world[Transform].position[simulation.world.row_numbers(Collider), 0]
    assert places[1:].max() < places[0]
    assert answered.looks_cut == 0
    assert most <= 2.0 * SPEED * DT / (TRUST * half)


def test_there_is_an_end_to_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    """In each substep, however many are struck in it; who comes to be faster than was known is detected anyway."""
    most, for_reach = 5, 2
    for way in ("response", "going_on"):
        monkeypatch.setattr(f"carom.systems.{way}.MOST_LOOKS", most)
    simulation = thrown(PILL, 5)
    answered = simulation.world[Answered]
    for _ in range(10):
        before = answered.detections
        simulation.step()
        assert answered.detections - before <= simulation.settings.substeps * (most + for_reach)
    assert answered.looks_cut > 0


def test_there_is_an_end_to_looks_at_which_nobody_is_detected() -> None:
    """A pull that may take a body anywhere lets nobody trust what is found for longer than it has just come."""
    simulation = Simulation(gravity=(0.0, -9.81, 0.0), dt=1.0 / 240.0)
    simulation.add(collider=CUBE, body={"mass": 1.0, "gravity_scale": -1e30}, transform={"position": (-0.65, 0.3, 0.0)})
    simulation.add(collider={"box": {"size": (2.4, 0.1, 0.3)}}, transform={"position": (0.0, 2.05, 0.0)})
    simulation.step()
    answered, settings = simulation.world[Answered], simulation.settings
    assert 0 < answered.looks <= settings.substeps * MOST_LOOKS
    assert answered.looks_cut > 0


def test_a_crowd_goes_the_same_way_whether_somebody_looks_on_or_not() -> None:
    """What is left of the trust in contacts is the same where substeps are taken at once."""
    alone, seen = thrown(CUBE, 3), thrown(CUBE, 3)
    alone.checked = seen.checked = False
    looked_on(seen)
    for _ in range(20):
        alone.step()
        seen.step()
        assert state_hash(alone.world) == state_hash(seen.world)


@pytest.mark.parametrize("collider", [CUBE, PILL], ids=["box", "capsule"])
def test_all_are_looked_at_as_often_where_they_ride_along(collider: dict[str, Any]) -> None:
    """In a train that moves much faster than they do in it: only how they move against each other counts."""

    def counts(along: float) -> list[tuple[int, int]]:
        simulation = Simulation(gravity=(0.0, 0.0, 0.0), dt=DT)
        moves = {"body": {"type": "kinematic"}, "motion": {"linear": (0.0, 0.0, along)}}
        simulation.add(collider={"box": {"size": (0.02, 20.0, 20.0)}}, **moves)
        motion = {"linear": (SPEED, 0.0, along), "angular": (1.0, 2.0, 3.0)}
        simulation.add(collider=collider, body={}, transform={"position": (-1.6, 0.0, 0.0)}, motion=motion)
        numbers = []
        for _ in range(5):
            simulation.step()
            numbers.append((simulation.world[Answered].detections, simulation.world[Answered].looks))
        return numbers

    at_rest = counts(0.0)
    assert max(number for _, number in at_rest) > 1
    assert counts(300.0) == at_rest


@pytest.mark.parametrize(("collider", "e"), [(CUBE, 0.0), (CUBE, 0.5), (BALL, 0.2)], ids=["box", "bounces", "ball"])
def test_who_is_in_front_is_not_driven_through_a_wall(collider: dict[str, Any], e: float) -> None:
    """By 300 who crash into each other at 150 m/s; nor do their bounces in the crush end only where they are cut.

    With as many blows as two that can be pushed have in a substep, up to 16 passed; with bounces without end a step
    took 800,000 impacts.
    """
    simulation, random = Simulation(gravity=(0.0, 0.0, 0.0), dt=DT), np.random.default_rng(1)
    simulation.add(collider={"box": {"size": (0.02, 60.0, 60.0)}}, material={"restitution": e})
    for i, j, k in [*np.ndindex(7, 7, 7)][:300]:
        simulation.add(
            collider=collider, body={}, material={"restitution": e},
            transform={"position": (-6.0 + 0.54 * i, 0.54 * j, 0.54 * k)},
            motion={"linear": (150.0, *random.uniform(0.0, 2.0, 2)), "angular": 3.0 * random.normal(size=3)},
        )  # fmt: skip
    simulation.step(8)
    places = simulation.world[Transform].position[simulation.world.row_numbers(Collider), 0]
    assert places[1:].max() < 0.0
    assert simulation.world[Answered].impacts_cut == 0


def tossed(speed: float, substeps: int) -> Simulation:
    """Return small boxes that are thrown about between walls, past nobody."""
    simulation, random = Simulation(substeps=substeps), np.random.default_rng(1)
    simulation.add(collider={"plane": {}}, material={"restitution": 0.7})
    for x, z in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        wall = {"box": {"size": (0.1 if x else 4.0, 8.0, 0.1 if z else 4.0)}}
        simulation.add(collider=wall, transform={"position": (2.0 * x, 4.0, 2.0 * z)})
    simulation.add(collider={"box": {"size": (4.0, 0.1, 4.0)}}, transform={"position": (0.0, -0.05, 0.0)})
    for k in range(12):
        simulation.add(
            collider={"box": {"size": (0.1, 0.06, 0.2)}}, body={"continuous": True}, material={"restitution": 0.8},
            transform={"position": (0.4 * (k % 3 - 1), 0.5 + 0.4 * (k // 3), 0.0)},
            motion={"linear": speed * random.normal(size=3), "angular": 5.0 * random.normal(size=3)},
        )  # fmt: skip
    return simulation


@pytest.mark.parametrize(("speed", "substeps"), [(5.0, 4), (15.0, 1)])
def test_a_snapshot_goes_on_where_bodies_are_fast(speed: float, substeps: int) -> None:
    """In a world that has not taken a step: who is to be looked after hangs on how bodies fall, to the last bit."""
    simulation = tossed(speed, substeps)
    before = take_snapshot(simulation.world)
    for _ in range(25):
        simulation.step()
        restored = tossed(speed, substeps)
        restore_snapshot(restored.world, before)
        restored.step()
        assert state_hash(restored.world) == state_hash(simulation.world)
        before = take_snapshot(simulation.world)
