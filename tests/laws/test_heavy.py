"""Heavy bodies stand on light ones: they sink in by what the springs between them yield, and come to rest."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform
from carom.systems.simulation import Simulation
from carom.systems.yielding import yielding

G, H = 9.81, 1.0 / 240.0
CORNER = 4.0  # what moves at a corner of a cube for each kg of it: its mass, and by 1/2 m about two axes of 1/6 kg m2


def column(ratio: float, below: int, aside: float = 0.0) -> Simulation:
    """Return a cube so many times as heavy as the cubes of 1 kg below it, of which it stands ``aside`` (m)."""
    simulation = Simulation(sleeping=False)
    simulation.add(collider={"plane": {}}, material={"friction": 0.5})
    for k in range(below + 1):
        heavy = k == below
        simulation.add(
            collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={"mass": ratio if heavy else 1.0},
            material={"friction": 0.5}, transform={"position": (aside if heavy else 0.0, 0.5 + k, 0.0)},
        )  # fmt: skip
    return simulation


def sunk(weight: float, inverse_masses: float, *, rigid: bool) -> float:
    """Return how deep (m) the corners of a cube are that bear so many weights of 1 kg between these two bodies.

    What overlap adds to the impulse of a corner makes up for the part of it that is lost (`aimed_at`).
    """
    rate, hardness, load, part = yielding(H)[rigid]
    bears = 0.25 * weight * G * CORNER * inverse_masses * H  # m/s
    return ((1.0 - hardness) * bears + (hardness - 1.0 + part) * max(0.0, bears - load)) / (hardness * rate)


@pytest.mark.parametrize(
    ("ratio", "below"),
    [(1.0, 3), *((ratio, below) for ratio in (10.0, 100.0, 250.0, 1000.0) for below in (1, 3)), (1000.0, 10)],
)
def test_a_heavy_cube_sinks_in_by_what_springs_yield_that_bear_it(ratio: float, below: int) -> None:
    """Of loads that piles do not reach they yield to less; to rounding, after 20 s."""
    simulation = column(ratio, below)
    simulation.step(1200)
    world = simulation.world
    rows = world.row_numbers(RigidBody)
    height = np.diff(world[Transform].position[rows, 1], prepend=-0.5)
    masses = [1.0] * below + [ratio]
    for k in range(below + 1):
        bodies = 1.0 / masses[k] + (1.0 / masses[k - 1] if k else 0.0)
        assert 1.0 - height[k] == pytest.approx(sunk(sum(masses[k:]), bodies, rigid=k == 0), rel=1e-9, abs=1e-12)
    assert np.abs(world[Motion].linear[rows]).max() < 1e-10


@pytest.mark.parametrize(
    ("ratio", "below", "aside"),
    [(ratio, below, aside) for ratio in (100.0, 250.0, 1000.0) for below in (1, 3) for aside in (0.1, 0.2, 0.3)],
)
def test_a_heavy_cube_that_stands_aside_comes_to_rest(ratio: float, below: int, aside: float) -> None:
    """Within 20 s: swept no more than others, three light cubes let 1,000 kg through, and fall under 250 kg."""
    simulation = column(ratio, below, aside)
    simulation.step(1200)
    assert np.abs(simulation.world[Motion].linear).max() < 1e-3


TABLES = [(mass, plate) for mass in (20.0, 100.0, 1000.0) for plate in (2.0, 10.0, 60.0)]


@pytest.mark.parametrize("leg", [1.0, 0.2], ids=["stout", "slim"])
@pytest.mark.parametrize(("mass", "plate"), TABLES)
def test_what_stands_on_a_table_comes_to_rest(mass: float, plate: float, leg: float) -> None:
    """On a plate (kg) on four legs of 1 kg, off its middle, after 12 s: plates rocked at millimetres a second.

    It stays within 2 mm where it was put, and each of the three contacts under it yields by no more than 8 mm.
    """
    simulation, random = Simulation(sleeping=False), np.random.default_rng(int(mass * plate))
    simulation.add(collider={"plane": {}}, material={"friction": 0.5})
    x, z = random.uniform(-0.6, 0.6, 2)
    legs = [((leg, 1.0, leg), 1.0, (i, 0.5, k)) for i in (-1.0, 1.0) for k in (-1.0, 1.0)]
    for size, kilograms, place in (*legs, ((3.0, 0.2, 3.0), plate, (0, 1.1, 0)), ((1.0, 1.0, 1.0), mass, (x, 1.7, z))):
        simulation.add(
            collider={"box": {"size": size}}, body={"mass": kilograms},
            material={"friction": 0.5}, transform={"position": place},
        )  # fmt: skip
    simulation.step(720)
    world = simulation.world
    rows = world.row_numbers(RigidBody)
    assert np.abs(world[Motion].linear).max() < 1e-3
    assert (np.abs(world[Transform].position[rows[-1]] - (x, 1.7, z)) < (0.002, 0.024, 0.002)).all()


def test_what_stands_on_a_joined_table_stays_there() -> None:
    """1,000 kg on a plate of 20 kg, legs of 2 kg on fixed joints, 10 s: within 2 cm; 14 if joints are swept no more.

    It does not come to rest.
    """
    simulation = Simulation(sleeping=False)
    simulation.add(collider={"plane": {}}, material={"friction": 0.5})
    place = {"position": (0.0, 1.1, 0.0)}
    plate = simulation.add(collider={"box": {"size": (3.0, 0.2, 3.0)}}, body={"mass": 20.0}, transform=place)
    for x, z in ((-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)):
        shape, place = {"box": {"size": (0.3, 0.98, 0.3)}}, {"position": (x, 0.49, z)}
        leg = simulation.add(collider=shape, body={"mass": 2.0}, transform=place)
        simulation.add(joint={"fixed": {"a": plate, "b": leg, "at": (x, 1.0, z)}})
    place = {"position": (0.3, 1.7, 0.2)}
    crate = simulation.add(collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={"mass": 1000.0}, transform=place)
    simulation.step(600)
    moved = simulation.world[Transform].position[simulation.world.row(crate)] - (0.3, 1.7, 0.2)
    assert np.abs(moved).max() < 0.02
