"""Piles of what bounces come to rest: what others press together does not strike for ever."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.spatial.distance import pdist

from carom.ecs import Motion, RigidBody, Transform
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.ecs.spatial import quaternion
from carom.systems.energy import total_energy
from carom.systems.simulation import Simulation

SIDE, HEIGHT = 3.4, 20.0  # m, of bins
SHAPES: dict[str, dict[str, Any]] = {
    "balls": {"sphere": {"radius": 0.5}},
    "boxes": {"box": {"size": (0.9, 0.9, 0.9)}},
    "capsules": {"capsule": {"radius": 0.35, "length": 0.3}},
    "cylinders": {"cylinder": {"radius": 0.4, "length": 0.8}},
}
#: Capsules would roll to and fro in hollows between others, which nothing slows: one of 27 did in one heap of twelve.
RESISTANCE: dict[str, dict[str, float]] = {"capsules": {"rolling_friction": 0.02, "spinning_friction": 0.02}}


def add_bin(simulation: Simulation, side: float, material: dict[str, float]) -> None:
    """Add a floor and four walls, with so many metres between them."""
    simulation.add(collider={"plane": {}}, material=material)
    for x, z in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)):
        size = (1.0, HEIGHT, side + 2.0) if x else (side + 2.0, HEIGHT, 1.0)
        place = {"position": (x * (side + 1.0) / 2.0, HEIGHT / 2.0, z * (side + 1.0) / 2.0)}
        simulation.add(collider={"box": {"size": size}}, transform=place, material=material)


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.8])
@pytest.mark.parametrize(
    ("shape", "masses"), [*((shape, (500.0,)) for shape in SHAPES), ("balls", (1.0, 100.0, 10.0))], ids=str
)
def test_nothing_strikes_in_a_pile_that_lies(shape: str, masses: tuple[float, ...], restitution: float) -> None:
    """Bodies dropped into a bin, where walls press them: after twelve seconds nobody strikes anybody for two more.

    Not even light ones that are wedged between heavy ones, which do not sink into them.
    """
    simulation, random = Simulation(checked=False), np.random.default_rng(0)
    material = {"restitution": restitution} | RESISTANCE.get(shape, {})
    add_bin(simulation, SIDE, material)
    places = 1.1 * np.stack(np.meshgrid([-1, 0, 1], [0, 1, 2], [-1, 0, 1], indexing="ij"), -1).reshape(-1, 3)
    places += np.array([0.0, 0.6, 0.0]) + random.uniform(-0.04, 0.04, places.shape)
    for k, place in enumerate(places):
        body = {"mass": masses[k % len(masses)]}
        simulation.add(collider=SHAPES[shape], body=body, transform={"position": tuple(place)}, material=material)
    simulation.step(720)  # until then a ball may roll, which nothing slows, and meet somebody
    for _ in range(120):
        simulation.step()
        assert simulation.world[Impact].count == 0
    rows, contact = simulation.world.row_numbers(RigidBody), simulation.world[Contact]
    assert np.abs(simulation.world[Transform].position[rows][:, [0, 2]]).max() < SIDE / 2.0
    assert np.linalg.norm(simulation.world[Motion].linear[rows], axis=1).max() <= 0.05  # balls roll on
    assert contact.depth[: contact.count].max() <= (0.005 if len(masses) == 1 else 0.02)


@pytest.mark.parametrize("masses", [(1.0,), (1.0, 100.0, 10.0)], ids=str)
@pytest.mark.parametrize("restitution", [0.0, 0.5, 0.9])
def test_a_pile_of_balls_falls_asleep(restitution: float, masses: tuple[float, ...]) -> None:
    """A hundred in a bin, which roll with resistance, within 15 s; none has sunk into another by 2 % of its size."""
    simulation, random = Simulation(checked=False, sleeping=True), np.random.default_rng(3)
    material = {"restitution": restitution, "rolling_friction": 0.02, "spinning_friction": 0.02}
    add_bin(simulation, 4.6, material)
    places = 1.1 * np.stack(np.meshgrid(range(4), range(7), range(4), indexing="ij"), -1).reshape(-1, 3)
    places += np.array([-1.65, 0.6, -1.65]) + random.uniform(-0.04, 0.04, places.shape)
    for k, place in enumerate(places):
        body = {"mass": masses[k % len(masses)]}
        simulation.add(collider=SHAPES["balls"], body=body, transform={"position": tuple(place)}, material=material)
    simulation.step(900)
    rows = simulation.world.row_numbers(RigidBody)
    assert simulation.world[Motion].asleep[rows].all()
    assert pdist(simulation.world[Transform].position[rows]).min() >= 0.98


def test_an_elastic_gas_keeps_its_energy() -> None:
    """Sixty balls in a box, under gravity: pairs that strike in substep after substep are not held together."""
    simulation, random = Simulation(checked=False), np.random.default_rng(2)
    elastic = {"restitution": 1.0, "friction": 0.0}
    for axis in range(3):
        for side in (-3.5, 3.5):
            size, place = [8.0] * 3, [0.0] * 3
            size[axis], place[axis] = 1.0, side
            simulation.add(collider={"box": {"size": size}}, transform={"position": place}, material=elastic)
    for k in range(60):
        simulation.add(
            collider={"sphere": {"radius": 0.3}}, body={"mass": 1.0}, material=elastic,
            transform={"position": (1.1 * (k % 5 - 2), 1.1 * (k // 25 - 2), 1.1 * (k // 5 % 5 - 2))},
            motion={"linear": 0.5 * random.normal(size=3)},
        )  # fmt: skip
    before = total_energy(simulation.world)
    simulation.step(900)
    assert total_energy(simulation.world) == pytest.approx(before, abs=1e-6)


def test_a_slow_gas_of_solids_keeps_its_energy() -> None:
    """Eight solids in a room come so slowly that they are as near as what rests for many substeps before they strike.

    Held there, without restitution, they lost 12 % of their energy in this time.
    """
    simulation, random = Simulation(gravity=(0.0, 0.0, 0.0), checked=False), np.random.default_rng(0)
    elastic = {"restitution": 1.0, "friction": 0.0}
    for axis in np.vstack([np.eye(3), -np.eye(3)]):
        simulation.add(collider={"plane": {"normal": tuple(axis), "offset": -0.7}}, material=elastic)
    solids = [{"box": {"size": (0.3, 0.5, 0.4)}}, {"cylinder": {"radius": 0.2, "length": 0.4}}]
    for k, place in enumerate(np.indices((2, 2, 2)).reshape(3, -1).T - 0.5):
        simulation.add(
            collider=solids[k % 2], body={"mass": 1.0}, material=elastic,
            transform={"position": 0.7 * place, "rotation": quaternion.normalise(random.normal(size=4))},
            motion={"linear": 0.02 * random.normal(size=3), "angular": 0.05 * random.normal(size=3)},
        )  # fmt: skip
    before = total_energy(simulation.world)
    simulation.step(1800)
    assert total_energy(simulation.world) == pytest.approx(before, rel=1e-9)


def test_a_crowd_of_elastic_balls_keeps_all_but_a_little() -> None:
    """Twelve between walls, each struck in substep after substep: one comes to rest that closes at less than 8 cm/s."""
    simulation, elastic = Simulation(checked=False), {"restitution": 1.0, "friction": 0.0}
    simulation.add(collider={"plane": {}}, material=elastic)
    for side in (-2.5, 2.5):
        box = {"box": {"size": (1.0, 4.0, 4.0)}}
        simulation.add(collider=box, transform={"position": (side, 2.0, 0.0)}, material=elastic)
    for k in range(12):
        simulation.add(
            collider={"sphere": {"radius": 0.4}}, body={"mass": 1.0, "sleeps": False}, material=elastic,
            transform={"position": (0.9 * (k % 4 - 1.5), 1.0 + 0.9 * (k // 4), 0.0)},
            motion={"linear": (0.3 * k - 1.0, 0.0, 0.0)},
        )  # fmt: skip
    before = total_energy(simulation.world)
    simulation.step(1200)
    assert total_energy(simulation.world) == pytest.approx(before, abs=0.01)  # of 233 J


@pytest.mark.parametrize("restitution", [0.0, 0.6])
@pytest.mark.parametrize("shape", SHAPES)
def test_what_is_thrown_from_where_it_lay_flies_at_once(shape: str, restitution: float) -> None:
    """It was pressed down a substep ago, and is not held: its way is that of the throw, to rounding."""
    simulation = Simulation(checked=False)
    simulation.add(collider={"plane": {}})
    thrown = simulation.add(
        collider=SHAPES[shape], body={"mass": 2.0}, material={"restitution": restitution},
        transform={"position": (0.0, 0.5, 0.0)},
    )  # fmt: skip
    simulation.step(240)
    before = simulation[thrown].transform.position.copy()
    simulation[thrown].motion.linear = (1.0, 3.0, 0.0)
    simulation.step(30)
    flown = simulation[thrown].transform.position - before
    assert np.abs(flown - (0.5, 1.5 - 9.81 / 8.0, 0.0)).max() <= 1e-12
    assert np.abs(simulation[thrown].motion.linear - (1.0, 3.0 - 4.905, 0.0)).max() <= 1e-12
