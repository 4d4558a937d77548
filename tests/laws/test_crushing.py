"""What is crushed between what drives it and what stands is not thrown out."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Material, Motion, RigidBody, Transform
from carom.ecs.relations.contact import Contact
from carom.systems.constants import CRUSHED, CRUSHED_PART
from carom.systems.kernels.crushing import let_go_of_crushed
from carom.systems.simulation import Simulation

FASTEST, AWAY = 12.0, 5.0  # m/s


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


@pytest.mark.parametrize("seed", range(3))
def test_what_was_crushed_lies_in_the_bin_once_the_press_opens(seed: int) -> None:
    """Also who was below those whom the plate touched; one left at 190 m/s.

    Rows of bodies may be wedged between two walls as long as they rub; without friction nobody is in anybody.
    """
    simulation = in_a_press(seed)
    simulation.step(150)
    world = simulation.world
    rows = world.row_numbers(RigidBody)
    driven = world[RigidBody].inverse_mass[rows] == 0.0
    with world.edit(Motion) as motion:
        motion.linear[rows[driven]] *= -1.0
    fastest = 0.0
    for step in range(300):
        if step == 180:
            with world.edit(Material) as material:
                material.friction[:] = 0.0
        simulation.step()
        fastest = max(fastest, float(np.linalg.norm(world[Motion].linear[rows[~driven]], axis=1).max()))
    assert fastest < FASTEST
    assert world[Transform].position[rows[~driven], 1].max() < 3.0
    contact = world[Contact]
    assert contact.depth[: contact.count].max() < CRUSHED


@pytest.mark.parametrize("speed", [0.01, 0.1, 1.0])
@pytest.mark.parametrize(
    "collider", [{"box": {"size": (1.0, 1.0, 1.0)}}, {"sphere": {"radius": 0.5}}], ids=["box", "sphere"]
)
def test_who_is_let_go_of_sideways_is_not_shot_out(collider: dict[str, Any], speed: float) -> None:
    """All overlap is with the floor, whose contact is solved after that with the plate; it left at 1,100 m/s."""
    simulation = Simulation(dt=1 / 60, sleeping=False)
    world = simulation.world
    simulation.add(collider={"plane": {}})
    body = simulation.add(collider=collider, body={}, transform={"position": (0.0, 0.5, 0.0)})
    plate = simulation.add(
        collider={"box": {"size": (3.0, 1.0, 3.0)}}, body={"type": "kinematic"},
        transform={"position": (0.0, 1.45, 0.0)}, motion={"linear": (0.0, -speed, 0.0)},
    )  # fmt: skip
    simulation.step(int(18.0 / speed))
    with world.edit(Motion) as motion:
        motion.linear[world.row(plate)] = AWAY, 0.0, 0.0
    fastest = 0.0
    for _ in range(60):
        simulation.step()
        fastest = max(fastest, float(np.linalg.norm(world[Motion].linear[world.row(body)])))
    assert 1.0 < fastest < AWAY


def test_only_who_is_between_what_drives_and_what_stands_is_crushed() -> None:
    """And overlaps somebody: not who touches nobody driven, nor nobody who stands, nor who but touches crushed ones."""
    drives, stands, crushed, touches, carried, rides, lies = range(7)
    a = np.array([drives, crushed, crushed, drives, carried, lies])
    b = np.array([crushed, touches, -1, carried, rides, stands])
    depth = np.array([0.1, 0.1, 2.0, 0.1, 2.0, 2.0]) * CRUSHED
    inverse_mass, linear, angular = np.array([0.0, 0.0, *[1.0] * 5]), np.zeros((7, 3)), np.zeros((7, 3))
    for turn in (linear, angular):
        turn[drives] = 0.0, -1.0, 0.0
        normal, rubs, rolls = np.ones(6), np.ones((6, 3)), np.ones((6, 3))
        found = np.ones(8, np.bool_)
        arguments = np.arange(7), 6, a, b, depth, inverse_mass, linear, angular, normal, rubs, rolls, found
        assert let_go_of_crushed(*arguments)
        assert np.flatnonzero(found).tolist() == [crushed]
        kept = [*[CRUSHED_PART] * 3, 1.0, 1.0, 1.0]
        assert np.column_stack([normal, rubs, rolls]).tolist() == [[part] * 7 for part in kept]
        turn[drives] = 0.0
        assert not let_go_of_crushed(*arguments)
        assert not found.any()
        assert normal.tolist() == kept
