"""Heavy bodies stand on light ones: they sink in by what the springs between them yield, and come to rest."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from onlookers import looked_on

from carom.ecs import Entity, Motion, RigidBody, Transform, state_hash
from carom.systems.constants import BEARING_SWEEPS
from carom.systems.resting import Resting
from carom.systems.simulation import Simulation
from carom.systems.yielding import yielding

G, H = 9.81, 1.0 / 240.0
CORNER = 4.0  # what moves at a corner of a cube for each kg of it: its mass, and by 1/2 m about two axes of 1/6 kg m2


def column(ratio: float, below: int, aside: float = 0.0, *, columns: int = 1, **settings: Any) -> Simulation:
    """Return a cube so many times as heavy as the cubes of 1 kg below it, of which it stands ``aside`` (m).

    Or so many such ``columns``, 3 m apart.
    """
    simulation = Simulation(sleeping=False, **settings)
    simulation.add(collider={"plane": {}}, material={"friction": 0.5})
    for x in 3.0 * np.arange(columns):
        for k in range(below + 1):
            heavy = k == below
            simulation.add(
                collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={"mass": ratio if heavy else 1.0},
                material={"friction": 0.5}, transform={"position": (x + aside if heavy else x, 0.5 + k, 0.0)},
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
    simulation = column(ratio, below, checked=False)
    simulation.step(1200)
    world = simulation.world
    rows = world.row_numbers(RigidBody)
    height = np.diff(world[Transform].position[rows, 1], prepend=-0.5)
    masses = [1.0] * below + [ratio]
    for k in range(below + 1):
        bodies = 1.0 / masses[k] + (1.0 / masses[k - 1] if k else 0.0)
        assert 1.0 - height[k] == pytest.approx(sunk(sum(masses[k:]), bodies, rigid=k == 0), rel=1e-9, abs=1e-12)
    assert np.abs(world[Motion].linear[rows]).max() < 1e-10


@pytest.mark.parametrize("resistance", [0.0, 0.02])
@pytest.mark.parametrize(("ratio", "below"), [(ratio, below) for ratio in (10.0, 100.0, 1000.0) for below in (1, 3)])
def test_so_does_a_heavy_ball(ratio: float, below: int, resistance: float) -> None:
    """On light ones: to rounding, but where loads are such as piles do not reach up to half as deep again."""
    simulation = Simulation(sleeping=False, checked=False)
    rolls = {"rolling_friction": resistance}
    simulation.add(collider={"plane": {}}, material=rolls)
    masses = [1.0] * below + [ratio]
    for k, mass in enumerate(masses):
        simulation.add(
            collider={"sphere": {"radius": 0.5}}, body={"mass": mass}, material=rolls,
            transform={"position": (0.0, 0.5 + k, 0.0)},
        )  # fmt: skip
    simulation.step(1200)
    height = np.diff(simulation.world[Transform].position[simulation.world.row_numbers(RigidBody), 1], prepend=-0.5)
    for k in range(below + 1):
        bodies = 1.0 / masses[k] + (1.0 / masses[k - 1] if k else 0.0)
        yields = sunk(sum(masses[k:]), bodies, rigid=k == 0)
        least, most = (0.99, 1.5) if ratio > 10.0 else (1.0, 1.0)
        assert least * yields - 1e-11 <= 1.0 - height[k] <= most * yields + 1e-11
    assert np.abs(simulation.world[Motion].linear).max() < 1e-10


@pytest.mark.parametrize(
    ("ratio", "below", "aside"),
    [(ratio, below, aside) for ratio in (100.0, 250.0, 1000.0) for below in (1, 3) for aside in (0.1, 0.2, 0.3)],
)
def test_a_heavy_cube_that_stands_aside_comes_to_rest(ratio: float, below: int, aside: float) -> None:
    """Within 20 s: swept no more than others, three light cubes let 1,000 kg through, and fall under 250 kg."""
    simulation = column(ratio, below, aside, checked=False)
    simulation.step(1200)
    assert np.abs(simulation.world[Motion].linear).max() < 1e-3


TABLES = [(mass, plate) for mass in (20.0, 100.0, 1000.0) for plate in (2.0, 10.0, 60.0)]


@pytest.mark.parametrize("leg", [1.0, 0.2], ids=["stout", "slim"])
@pytest.mark.parametrize(("mass", "plate"), TABLES)
def test_what_stands_on_a_table_comes_to_rest(mass: float, plate: float, leg: float) -> None:
    """On a plate (kg) on four legs of 1 kg, off its middle, after 12 s: plates rocked at millimetres a second.

    It stays within 2 mm where it was put, and each of the three contacts under it yields by no more than 8 mm.
    """
    simulation, random = Simulation(sleeping=False, checked=False), np.random.default_rng(int(mass * plate))
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


def joined_table(
    simulation: Simulation, crate: float, plate: float, leg: float, *, wheels: bool = False, z: float = 0.0
) -> list[Entity]:
    """Put a crate (kg), off the middle, on a plate that is joined to four legs, or to wheels that turn; return all."""
    place = {"position": (0.0, 1.1, z)}
    found = [simulation.add(collider={"box": {"size": (3.0, 0.2, 3.0)}}, body={"mass": plate}, transform=place)]
    for x, beside in ((-1.0, z - 1.0), (-1.0, z + 1.0), (1.0, z - 1.0), (1.0, z + 1.0)):
        shape = {"sphere": {"radius": 0.49}} if wheels else {"box": {"size": (0.3, 0.98, 0.3)}}
        found.append(simulation.add(collider=shape, body={"mass": leg}, transform={"position": (x, 0.49, beside)}))
        holds = {"a": found[0], "b": found[-1], "at": (x, 0.49 if wheels else 1.0, beside)}
        simulation.add(joint={"hinge": {**holds, "axis": (0.0, 0.0, 1.0)}} if wheels else {"fixed": holds})
    place = {"position": (0.3, 1.7, z + 0.2)}
    found.append(simulation.add(collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={"mass": crate}, transform=place))
    return found


JOINED = [
    (10, 10, 0.5),
    (30, 10, 0.5),
    (30, 10, 1),
    (70, 10, 1),
    (70, 10, 2),
    (100, 10, 1),
    (300, 10, 2),
    (1000, 20, 2),
]


@pytest.mark.parametrize("wheels", [False, True], ids=["legs", "wheels"])
@pytest.mark.parametrize(("crate", "plate", "leg"), JOINED)
def test_what_stands_on_a_joined_table_comes_to_rest(crate: float, plate: float, leg: float, wheels: bool) -> None:
    """To 1e-5 m/s within 10 s, less than 5 mm aside from where it was put.

    Where joints are swept no more than others, 1,000 kg drift by 14 cm; where only those who bear are, not who is
    joined to them, they rock at 0.14 m/s; and where loads of joined bodies do not count, 70 kg do at 1 cm/s.
    """
    simulation = Simulation(sleeping=False, checked=False)
    simulation.add(collider={"plane": {}}, material={"friction": 0.5})
    row = simulation.world.row(joined_table(simulation, crate, plate, leg, wheels=wheels)[-1])
    simulation.step(600)
    moved = simulation.world[Transform].position[row] - (0.3, 1.7, 0.2)
    assert np.abs(simulation.world[Motion].linear).max() < 1e-5
    assert (np.abs(moved) < (0.005, 0.012, 0.005)).all()


def hang_chain(simulation: Simulation) -> list[Entity]:
    """Hang six links by one end, with ball and fixed joints in turns, and return them."""
    links: list[Entity] = []
    for k in range(6):
        ball, place = {"sphere": {"radius": 0.1}}, {"position": (float(k), 9.0, 20.0)}
        links.append(simulation.add(collider=ball, body={"mass": 1.0}, transform=place))
        holds = {"a": links[-2] if k else None, "b": links[-1], "at": (k - 0.5, 9.0, 20.0)}
        simulation.add(joint={"fixed" if k % 2 else "ball": holds})
    return links


def test_joints_of_others_are_swept_no_more_for_who_is_heavy() -> None:
    """A chain that swings beside a table under 100 kg, with joints in the same groups, goes where it would alone."""
    found = []
    for tables in (0, 1):
        simulation = Simulation(sleeping=False, checked=False)
        simulation.add(collider={"plane": {}})
        if tables:
            joined_table(simulation, 100.0, 10.0, 1.0)
        links = hang_chain(simulation)
        simulation.step(60)
        found.append(simulation.world[Transform].position[[simulation.world.row(link) for link in links]])
    np.testing.assert_array_equal(*found)


@pytest.mark.parametrize("other", ["heard", "two threads", "seen"])
@pytest.mark.parametrize("tables", [0, 4])
def test_heavy_bodies_stand_alike_whoever_listens_and_however_many_solve(
    other: str, tables: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """To the bit, with sweeps on for who bears 1,000 kg, on columns and on joined tables."""
    monkeypatch.setattr("carom.systems.threads.processors", lambda: 8)
    monkeypatch.setattr("carom.systems.threads.FEWEST", 32)
    sweeps, worlds = [0], []
    for alone in (True, False):
        threads = 2 if other == "two threads" and not alone else 1
        simulation = column(1000.0, 3, 0.2, columns=20, checked=False, threads=threads)
        looked_on(simulation, other == "seen" and not alone)
        for k in range(tables):
            joined_table(simulation, 1000.0, 20.0, 2.0, z=5.0 + 5.0 * k)
        if other == "heard" and not alone:
            simulation.world[Resting].hearers.append(lambda _, number: sweeps.append(number))
        for _ in range(30):
            simulation.step()
        assert simulation.world[Resting].count >= 32
        worlds.append(simulation.world)
    assert state_hash(worlds[0]) == state_hash(worlds[1])
    assert other != "heard" or max(sweeps) > BEARING_SWEEPS
