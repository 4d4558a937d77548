"""The cache of the broad phase: the pairs are the same without it, and a settled pile costs nothing."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from broad_pairs import agree, crowd, move, pairs_now
from hypothesis import given, settings
from hypothesis import strategies as st
from pairs import turns

from carom.ecs import Collider, Motion, RigidBody, Transform, World, restore_snapshot, state_hash, take_snapshot
from carom.systems.detection.broad import BroadPhase
from carom.systems.shapes.plane import Plane
from carom.systems.simulation import Simulation

LAYERS = ("default", "left", "right", "ghost", "none")
ORIGINS = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (-3.0, 5.0, 1.0), (1e5, 0.0, 0.0), (1e8, -1e8, 1e8))
Random = np.random.Generator


def any_collider(generator: Random) -> dict[str, Any]:
    """Draw a shape of 1 mm to 1 km: ball, box, rod, plate, point or plane."""
    size = 10.0 ** generator.uniform(-3.0, 3.0)
    shape = (
        {"sphere": {"radius": size}},
        {"box": {"size": size * generator.uniform(0.5, 1.0, 3)}},
        {"box": {"size": size * np.array([1.0, 1e-3, 1e-3])}},
        {"box": {"size": size * np.array([1.0, 1.0, 1e-3])}},
        {"point": {}},
        {"plane": {"normal": generator.normal(size=3), "offset": generator.normal()}},
    )[generator.choice(6, p=(0.4, 0.2, 0.12, 0.12, 0.1, 0.06))]
    layer = LAYERS[generator.choice(5, p=(0.6, 0.15, 0.1, 0.1, 0.05))]
    return {**shape, "layer": layer, "sensor": bool(generator.random() < 0.1)}


def add_any(simulation: Simulation, generator: Random, spread: float) -> None:
    """Add a collider somewhere in one of the clusters, static or moving."""
    collider = any_collider(generator)
    moves = "plane" not in collider and generator.random() < 0.7
    place = np.array(ORIGINS[generator.integers(len(ORIGINS))]) + generator.normal(size=3) * spread
    simulation.add(
        collider=collider,
        body={"mass": 1.0, "inertia": (1.0, 1.0, 1.0)} if moves else None,
        motion={"linear": generator.normal(size=3) * spread} if moves else None,
        transform={"position": place, "rotation": turns(generator)},
        visual=False,
    )


def happen(simulation: Simulation, generator: Random, saved: list[Any]) -> None:
    """Let something befall a world between two detections."""
    world, spread = simulation.world, 3.0
    rows = world.row_numbers(Collider)
    some = rows[generator.random(len(rows)) < generator.choice([0.0, 0.05, 0.3, 1.0])]
    chance = generator.integers(13)
    with world.edit(Transform) as transform:
        transform.position[some] += generator.normal(size=(len(some), 3)) * 10.0 ** generator.uniform(-6.0, 1.0)
    if chance == 0 and len(rows) > 2:
        world.despawn(world.entities(rows[[generator.integers(len(rows))]])[0])
    elif chance == 1:
        add_any(simulation, generator, spread)
    elif chance == 2:
        world.compact()
    elif chance == 3:
        with world.edit(Collider) as collider:
            collider.layer[some] = 1 << generator.integers(4)
    elif chance == 4:
        with world.edit(Collider) as collider:
            collider.sensor[some] ^= True
    elif chance == 5:
        saved.append(take_snapshot(world))
    elif chance == 6 and saved:
        restore_snapshot(world, saved[generator.integers(len(saved))])
    elif chance == 7:
        world[BroadPhase].drop()
    elif chance == 8:
        with world.edit(Motion) as motion:
            motion.linear[some] *= 10.0
    elif chance == 9:  # what another size or shape is to the broad phase, of planes their own numbers
        with world.edit(Collider) as collider:
            factor = 10.0 ** generator.uniform(-1.0, 1.0)
            for column in (collider.bound_half, collider.bound_radius, collider.size):
                column[some] *= factor
    elif chance == 10 and len(rows):
        stand_or_move(world, world.entities(rows[[generator.integers(len(rows))]]).tolist()[0])


def stand_or_move(world: World, entity: int) -> None:
    """Make a body of what was none, or the other way round."""
    if RigidBody in world[entity]:
        world.detach(entity, RigidBody)
    elif world[Collider].shape[world.row(entity)] != Plane.number:
        world.attach(entity, RigidBody())


@given(st.integers(0, 2**32), st.integers(2, 40), st.sampled_from([0.01, 1.0, 30.0]))
@settings(max_examples=60)
def test_the_pairs_are_those_of_brute_force(seed: int, count: int, spread: float) -> None:
    """Whatever comes, goes, moves, grows, stands still, changes layer or is restored, as a cache saw all or none."""
    generator = np.random.default_rng(seed)
    simulation = Simulation()
    simulation.layers({"left": ["left", "default"], "right": ["right", "left"], "ghost": []})
    for _ in range(count):
        add_any(simulation, generator, spread)
    saved: list[Any] = []
    for _ in range(12):
        agree(simulation.world)
        happen(simulation, generator, saved)
    found = agree(simulation.world)
    simulation.world[BroadPhase].drop()
    assert pairs_now(simulation.world).tobytes() == found.tobytes()


def test_a_settled_crowd_is_not_looked_up_again() -> None:
    """Within their fat bounds nothing is; a few that leave are looked up alone; with many all is built anew."""
    simulation = crowd(400, spread=0.9)
    simulation.add(collider={"plane": {}})
    cache = simulation.world[BroadPhase]
    agree(simulation.world)
    index, pairs = cache.index, cache.pairs
    for _ in range(5):
        move(simulation, slice(0, 400), 0.002)
        agree(simulation.world)
    assert cache.index is index and cache.pairs is pairs
    move(simulation, [3, 90], 0.2)
    agree(simulation.world)
    assert cache.index is index and cache.pairs is not pairs
    assert cache.index.strays.tolist() == [3, 90]
    move(simulation, slice(0, 100), 0.2)
    agree(simulation.world)
    assert cache.index is not index
    assert not len(cache.index.strays)


def test_a_plane_that_moves_is_noticed() -> None:
    """Also one that is turned or whose parameters change."""
    simulation = crowd(30, spread=2.0)
    plane = simulation.add(collider={"plane": {}}, transform={"position": (0.0, -9.0, 0.0)})
    row = simulation.world.row(plane)
    assert len(agree(simulation.world)) == 0
    move(simulation, row, (0.0, 10.0, 0.0))
    assert 0 < len(agree(simulation.world)) < 30
    with simulation.world.edit(Collider) as collider:
        collider.size[row, 3] = 100.0
    assert len(agree(simulation.world)) == 30


def test_a_body_that_stands_still_from_now_on_is_noticed() -> None:
    """Two that overlap are no pair once neither is a body, and are again when one becomes one."""
    simulation = crowd(2, spread=0.5)
    world = simulation.world
    one, other = world.entities(world.row_numbers(Collider)).tolist()
    assert len(agree(world)) == 1
    world.detach(one, RigidBody)
    assert len(agree(world)) == 1
    world.detach(other, RigidBody)
    assert len(agree(world)) == 0
    world.attach(one, RigidBody())
    assert len(agree(world)) == 1


@pytest.mark.parametrize("seed", range(3))
def test_the_future_is_the_same_without_a_cache(seed: int) -> None:
    """Dropped at random times, in a pile that forms: the same state to the last bit."""
    hashes = []
    for chance in (0.0, 0.3):
        generator = np.random.default_rng(seed)
        simulation = crowd(60, spread=1.05, seed=seed)
        simulation.add(collider={"plane": {}}, transform={"position": (0.0, -1.0, 0.0)})
        for _ in range(60):
            if generator.random() < chance:
                simulation.world[BroadPhase].drop()
            simulation.step()
        hashes.append(state_hash(simulation.world))
    assert hashes[0] == hashes[1]
