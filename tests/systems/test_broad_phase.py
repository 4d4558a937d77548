"""Broad phase: no pair missed, none too many, whatever the cache has seen; and a settled pile costs nothing."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pairs import turns

from carom.ecs import (
    Collider,
    ColliderPose,
    Motion,
    RigidBody,
    Transform,
    World,
    restore_snapshot,
    state_hash,
    take_snapshot,
)
from carom.ecs.column import Booleans, Integers
from carom.ecs.spatial import quaternion
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.broad import BroadPhase, overlapping
from carom.systems.shapes.plane import Plane
from carom.systems.simulation import Simulation

DT = 1 / 60
LAYERS = ("default", "left", "right", "ghost", "none")
ORIGINS = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (-3.0, 5.0, 1.0), (1e5, 0.0, 0.0), (1e8, -1e8, 1e8))
Random = np.random.Generator


def pairs_now(world: World) -> Integers:
    """Place all colliders and return the pairs of the broad phase."""
    with world.faces(None):
        reach_within(world, DT)
        return overlapping(world)


def brute_force(world: World) -> Integers:
    """Return what must be found, every row tested against every other."""
    collider, pose, rows = world[Collider], world[ColliderPose], world.row_numbers(Collider)
    lower, upper, body = pose.lower[rows], pose.upper[rows], pose.body_row[rows]
    layer, mask, sensor = collider.layer[rows], collider.mask[rows], collider.sensor[rows]
    meets: Booleans = np.ones((len(rows), len(rows)), np.bool_)
    for k in range(3):
        below = lower[:, k, None] <= upper[None, :, k]
        meets &= below & below.T
    for k in np.nonzero(collider.shape[rows] == Plane.number)[0]:
        normal = quaternion.rotate(pose.rotation[rows[k]], collider.size[rows[k], :3])
        corners = np.where(normal > 0.0, lower, upper) - pose.position[rows[k]]
        along = np.where(normal == 0.0, 0.0, corners) * normal
        meets[k] = meets[:, k] = along.sum(axis=1) <= collider.size[rows[k], 3]
    accepted = (mask[:, None] & layer[None]) != 0
    meets &= accepted & accepted.T & (body[:, None] != body[None]) & ~(sensor[:, None] & sensor[None])
    a, b = np.nonzero(np.triu(meets, 1))
    return np.stack((rows[a], rows[b]), axis=1)


def agree(world: World) -> Integers:
    """Return the pairs of the broad phase, which must be those of brute force."""
    found = pairs_now(world)
    assert found.tolist() == brute_force(world).tolist()
    return found


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


def crowd(count: int, *, spread: float, seed: int = 0) -> Simulation:
    """Return balls of half a metre, jittered about a lattice of this spacing."""
    simulation = Simulation(checked=False)
    edge = int(np.ceil(count ** (1 / 3)))
    lattice = np.stack(np.unravel_index(np.arange(count), (edge, edge, edge)), axis=1).astype(np.float64)
    places = (lattice + np.random.default_rng(seed).uniform(-0.15, 0.15, (count, 3))) * spread
    simulation.add_many(places, collider={"sphere": {"radius": 0.5}}, body={}, visual=False)
    return simulation


def move(simulation: Simulation, rows: Any, by: Any) -> None:
    """Shift rows."""
    with simulation.world.edit(Transform) as transform:
        transform.position[rows] += by


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
