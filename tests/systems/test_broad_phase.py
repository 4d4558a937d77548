"""Broad phase: no pair missed, none too many, wherever bodies are."""

from __future__ import annotations

import numpy as np
import pytest
from broad_pairs import DT, agree, crowd, move, pairs_now

from carom.ecs import Motion, Transform
from carom.ecs.relations.contact import Contact
from carom.systems.detection import contacts
from carom.systems.detection.broad import BroadPhase
from carom.systems.progress import Progress
from carom.systems.simulation import Simulation


@pytest.mark.parametrize("step", [0.0005, 0.02, 0.5])
def test_a_crowd_of_all_sizes_on_the_move(step: float) -> None:
    """Balls and boxes from 1 cm to 100 m, many of one size, static tiles and a floor: 8 frames of drift."""
    simulation = crowd(500, spread=0.9)
    generator = np.random.default_rng(1)
    simulation.add(collider={"plane": {}}, transform={"position": (0.0, 1.0, 0.0)})
    simulation.add(collider={"box": {"size": (100.0, 1.0, 100.0)}})
    tiles = np.stack(np.meshgrid(np.arange(12.0), [0.0], np.arange(12.0)), axis=-1).reshape(-1, 3)
    simulation.add_many(tiles, collider={"box": {"size": (1.0, 0.2, 1.0)}}, visual=False)
    for _ in range(150):
        size = 10.0 ** generator.uniform(-2.0, 2.0)
        simulation.add(
            collider={"box": {"size": (size, size, size)}},
            body={"mass": 1.0},
            transform={"position": generator.uniform(-1.0, 10.0, 3)},
            visual=False,
        )
    drift = generator.normal(size=(simulation.world.used(), 3)) * step
    drift[generator.random(len(drift)) < 0.7] = 0.0
    for _ in range(8):
        agree(simulation.world)
        move(simulation, slice(0, len(drift)), drift)


def test_nobody_meets_nobody() -> None:
    """A world without colliders, before the first comes and after the last has gone."""
    simulation = Simulation()
    assert agree(simulation.world).shape == (0, 2)
    ball = simulation.add(collider={"sphere": {"radius": 0.5}}, body={})
    assert agree(simulation.world).shape == (0, 2)
    simulation.world.despawn(ball)
    assert agree(simulation.world).shape == (0, 2)


def test_one_large_body_does_not_spoil_the_grid() -> None:
    """Cells stay as large as most bodies are: the few that are larger go into the tree."""
    simulation = crowd(400, spread=0.9)
    for size in (0.1, 0.3, 1.5, 3.0, 30.0):
        simulation.add(collider={"box": {"size": (size, size, size)}}, body={}, visual=False)
    agree(simulation.world)
    index = simulation.world[BroadPhase].index
    assert index.cell[1].max() < 1.2
    assert len(index.grid_rows) >= 400


def test_who_flies_is_looked_up_anew_only_every_few_steps() -> None:
    """Bounds of the pair cache reach ahead for four steps of 0.1 m; the pairs are those of the moment."""
    simulation = Simulation(dt=DT, gravity=(0.0, 0.0, 0.0))
    places = np.stack(np.meshgrid(np.arange(0.0, 9.0, 1.5), [0.0], np.arange(0.0, 9.0, 1.5)), axis=-1).reshape(-1, 3)
    simulation.add_many(places, collider={"sphere": {"radius": 0.5}}, body={}, motion={"linear": (6.0, 0.0, 0.0)})
    simulation.add(collider={"box": {"size": (1.0, 1.0, 20.0)}}, transform={"position": (16.0, 0.0, 4.0)})
    seen = set()
    for _ in range(24):
        agree(simulation.world)
        seen.add(simulation.world[BroadPhase].fat_lower[0].tobytes())
        move(simulation, slice(0, len(places)), np.tile([6.0 * DT, 0.0, 0.0], (len(places), 1)))
    assert len(seen) <= 24 // 3


def test_all_in_one_place() -> None:
    """Bodies that all overlap are all pairs, in order."""
    simulation = crowd(40, spread=0.0)
    assert len(agree(simulation.world)) == 40 * 39 // 2


@pytest.mark.parametrize("far", [1e5, 1e8, 1e12, 1e200])
@pytest.mark.parametrize("direction", [(1.0, 0.0, 0.0), (1.0, -1.0, 1.0)])
def test_a_body_far_out_costs_the_others_nothing(far: float, direction: tuple[float, float, float]) -> None:
    """Pairs stay right, also those of two that are far out together, and no cell holds a crowd."""
    simulation = crowd(200, spread=0.9)
    expected = len(agree(simulation.world))
    move(simulation, [198, 199], far * np.array(direction))
    with simulation.world.edit(Transform) as transform:
        transform.position[199] = transform.position[198]
    found = agree(simulation.world)
    assert [198, 199] in found.tolist()
    assert 0 < len(found) < expected
    index = simulation.world[BroadPhase].index
    assert len(index.grid_rows) >= 198
    assert np.bincount(np.unique(index.grid_cells, return_inverse=True)[1]).max() <= 8


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_what_is_nowhere_meets_nobody(bad: float) -> None:
    """The pairs of the others stay as they are until the end of the step names who is not finite."""
    simulation = crowd(30, spread=0.9)
    simulation.add(collider={"plane": {}}, transform={"position": (0.0, 99.0, 0.0)})
    before = agree(simulation.world)
    for _ in range(2):
        with simulation.world.edit(Transform) as transform, np.errstate(invalid="ignore"):
            transform.position[7, 1] = bad
        found = pairs_now(simulation.world)
        assert found.tolist() == before[(before != 7).all(axis=1)].tolist()


def test_speed_beyond_all_bounds_meets_everyone() -> None:
    """Whose reach has no end is tested against all."""
    simulation = crowd(20, spread=30.0)
    simulation.add(collider={"plane": {}}, transform={"position": (0.0, -99.0, 0.0)})
    assert len(agree(simulation.world)) == 0
    with simulation.world.edit(Motion) as motion:
        motion.linear[3] = 1e308
    assert len(agree(simulation.world)) == 20


def test_gravel_has_no_contacts_with_all_that_is_near() -> None:
    """Cubes of 1 cm, their own size apart, find the corners of each on the ground and no neighbours."""
    simulation = Simulation(sleeping=False)
    simulation.add(collider={"plane": {}})
    for k in range(16):
        place = (0.02 * (k % 4), 0.005, 0.02 * (k // 4))
        simulation.add(transform={"position": place}, body={}, collider={"box": {"size": (0.01, 0.01, 0.01)}})
    simulation.step()
    contact = simulation.world[Contact]
    assert contact.row_a[: contact.count].tolist() == [0] * 64


def falling_gravel() -> Simulation:
    """Return 216 cubes of 1 cm that fall at 3 m/s, a centimetre apart; one flies off, so that they are no stream."""
    simulation = Simulation(sleeping=False)
    simulation.add(collider={"plane": {}})
    for k in range(216):
        place = (0.02 * (k % 6), 0.3 + 0.02 * (k // 36), 0.02 * (k // 6 % 6) + 0.001 * (k // 36 % 2))
        simulation.add(
            transform={"position": place}, motion={"linear": (0.0, -3.0, 0.0)}, body={},
            collider={"box": {"size": (0.01, 0.01, 0.01)}},
        )  # fmt: skip
    simulation.add(
        motion={"linear": (0.0, 3.0 * 216, 0.0)}, transform={"position": (99.0, 0.0, 0.0)}, body={"mass": 1.0}
    )
    return simulation


def test_gravel_that_falls_meets_only_what_it_may_within_a_substep(monkeypatch: pytest.MonkeyPatch) -> None:
    """It falls to the same bit with a third of the contacts, and lies on the ground in the end."""
    simulation = falling_gravel()
    contact, places = simulation.world[Contact], simulation.world[Transform].position
    simulation.step(4)
    assert simulation.world[Progress].crowded
    with monkeypatch.context() as patched:
        patched.setattr(contacts, "CROWDED", 10**9)
        other = falling_gravel()
        other.step(4)
    assert not other.world[Progress].crowded
    assert other.world[Contact].count > 2.5 * contact.count
    assert (places[1:217] == other.world[Transform].position[1:217]).all()
    simulation.step(60)
    assert not simulation.world[Progress].crowded
    assert places[1:217, 1].min() == pytest.approx(0.005, abs=5e-4)
