"""Energy and momentum of a world against their definitions."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs.spatial import quaternion
from carom.systems.energy import (
    angular_momentum,
    kinetic_and_potential,
    kinetic_energy,
    momentum,
    potential_energy,
    total_energy,
)
from carom.systems.simulation import Simulation
from carom.worlds import load_world

SIZE, MASS = np.array([0.3, 0.5, 0.7]), 2.0
INERTIA = MASS / 12.0 * np.array([0.25 + 0.49, 0.09 + 0.49, 0.09 + 0.25])


@pytest.mark.parametrize("seed", range(5))
def test_a_turning_box(seed: int) -> None:
    """Translation and rotation about any axis, by the inertia tensor in the world frame."""
    generator = np.random.default_rng(seed)
    place, velocity, spin = generator.normal(size=(3, 3))
    rotation = quaternion.normalise(generator.normal(size=4))
    simulation = Simulation(gravity=(0.0, -9.81, 0.0))
    simulation.add(
        transform={"position": place, "rotation": rotation},
        motion={"linear": velocity, "angular": spin},
        body={"mass": MASS},
        collider={"box": {"size": tuple(SIZE)}},
    )
    turn = quaternion.matrix(rotation)
    tensor = turn @ np.diag(INERTIA) @ turn.T
    world = simulation.world
    assert kinetic_energy(world) == pytest.approx(
        0.5 * MASS * velocity @ velocity + 0.5 * spin @ tensor @ spin, rel=1e-12
    )
    assert potential_energy(world) == pytest.approx(MASS * 9.81 * place[1], rel=1e-12)
    assert total_energy(world) == pytest.approx(kinetic_energy(world) + potential_energy(world), rel=1e-12)
    np.testing.assert_allclose(momentum(world), MASS * velocity, rtol=1e-12)
    np.testing.assert_allclose(angular_momentum(world), MASS * np.cross(place, velocity) + tensor @ spin, atol=1e-12)


def test_a_centre_of_mass_beside_the_origin() -> None:
    """Height and lever arm are those of the centre of mass, not of the authored origin."""
    simulation = Simulation(gravity=(0.0, -10.0, 0.0))
    simulation.add(
        transform={"rotation": quaternion.from_axis_angle((0, 0, 1), np.pi / 2)},
        motion={"linear": (0.0, 0.0, 3.0)},
        body={"mass": 2.0, "center_of_mass": (1.0, 0.0, 0.0)},
        collider={"sphere": {"radius": 0.1}},
    )
    assert potential_energy(simulation.world) == pytest.approx(20.0)
    np.testing.assert_allclose(angular_momentum(simulation.world), [6.0, 0.0, 0.0], atol=1e-12)


def test_mutual_gravitation() -> None:
    """Each pair counts once, softened as its force is."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    for place, mass in (((0, 0, 0), 1.0), ((3, 0, 0), 2.0), ((0, 4, 0), 3.0)):
        simulation.add(transform={"position": place}, body={"mass": mass}, collider={"point": {}})
    simulation.force("mutual_gravitation", constant=2.0, softening=1.0)
    pairs = 1 * 2 / np.sqrt(9 + 1) + 1 * 3 / np.sqrt(16 + 1) + 2 * 3 / np.sqrt(25 + 1)
    assert potential_energy(simulation.world) == pytest.approx(-2.0 * pairs, rel=1e-12)


def test_kinematic_and_static_things_have_none() -> None:
    """Only what obeys forces has energy."""
    simulation = Simulation()
    box = {"box": {"size": (1.0, 1.0, 1.0)}}
    simulation.add(collider=box)
    simulation.add(collider=box, body={"type": "kinematic"}, motion={"linear": (1.0, 0.0, 0.0)})
    assert total_energy(simulation.world) == 0.0
    assert not momentum(simulation.world).any()


def test_both_energies_in_one_are_those_one_by_one() -> None:
    """Turning boxes, balls off their origins, springs and what does not move, to rounding."""
    simulation = load_world("bowling").simulation
    simulation.step(200)
    for world in (simulation.world, load_world("gravity_well").simulation.world):
        kinetic, potential = kinetic_and_potential(world)
        assert kinetic == pytest.approx(kinetic_energy(world), rel=1e-12)
        assert potential == pytest.approx(potential_energy(world), rel=1e-12)
