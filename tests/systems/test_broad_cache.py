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
from carom.systems.constants import AHEAD, FEW_BESIDE
from carom.systems.detection.broad import BroadPhase
from carom.systems.shapes.plane import Plane
from carom.systems.simulation import Simulation
from carom.systems.stream import Stream

LAYERS = ("default", "left", "right", "ghost", "none")
ORIGINS = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (-3.0, 5.0, 1.0), (1e5, 0.0, 0.0), (1e8, -1e8, 1e8))
Random = np.random.Generator
END: dict[str, Any] = {"collider": {"plane": {"normal": (-1.0, 0.0, 0.0), "offset": -18.0}}}  # of all, at x = 18 m


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


def move_along(simulation: Simulation, velocity: Any) -> None:
    """Have the first 64 fly with one velocity."""
    with simulation.world.edit(Motion) as motion:
        motion.linear[:64] = velocity


@pytest.mark.parametrize("seed", range(8))
def test_the_pairs_are_those_of_brute_force_in_streams(seed: int) -> None:
    """Of a crowd that flies now this way and now that, or falls, past others, who are few or many."""
    generator = np.random.default_rng(seed)
    simulation = crowd(64, spread=1.0, seed=seed)
    move_along(simulation, (30.0, 0.0, 0.0))
    world, saved, flew = simulation.world, [take_snapshot(simulation.world)], 0
    for _ in range(40):
        what = generator.integers(8)
        if what == 0:
            move_along(simulation, generator.normal(size=3) * 10.0 ** generator.uniform(-1.0, 3.0))
        elif what == 1:
            move_along(simulation, (0.0, 0.0, 0.0))
        elif what in {2, 3}:
            place = world[Transform].position[:64].mean(axis=0) + generator.normal(size=3) * 8.0
            moves = {} if what == 2 else {"body": {}}
            simulation.add(collider={"sphere": {"radius": 1.0}}, transform={"position": place}, visual=False, **moves)
        elif what == 4:
            saved.append(take_snapshot(world))
        elif what == 5 and generator.random() < 0.3:
            restore_snapshot(world, saved[generator.integers(len(saved))])
        simulation.step()
        agree(world)
        flew += bool(world[Stream].motion[0].any())
    assert flew


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


def tumbling(speed: float, *others: dict[str, Any]) -> Simulation:
    """Return 125 boxes that tumble and fly along x, 3 m from each other, among others that they pass through."""
    simulation, random = Simulation(gravity=(0.0, 0.0, 0.0)), np.random.default_rng(2)
    for place in 3.0 * np.stack(np.unravel_index(np.arange(125), (5, 5, 5)), axis=1):
        simulation.add(
            collider={"box": {"size": (0.6, 0.4, 0.2)}}, body={}, transform={"position": place},
            motion={"linear": random.uniform((speed - 0.2, -0.2, -0.2), (speed + 0.2, 0.2, 0.2)),
                    "angular": random.uniform(-2.0, 2.0, 3)},
        )  # fmt: skip
    for other in others:
        simulation.add(**other)
    agree(simulation.world)
    return simulation


def gate(x: float) -> dict[str, Any]:
    """Return a gate there (m), through which they fly."""
    return {"collider": {"box": {"size": (0.5, 20.0, 20.0)}, "sensor": True}, "transform": {"position": (x, 0.0, 0.0)}}


def widths(simulation: Simulation) -> Any:
    """Return how wide (m) the fat bounds of those who tumble are."""
    cache = simulation.world[BroadPhase]
    return (cache.fat_upper - cache.fat_lower)[:125]


def test_who_tumbles_stays_within_its_fat_bounds() -> None:
    """For as many steps as they are made for, or half of that where a box comes to be twice as wide."""
    simulation = tumbling(0.0)
    index = simulation.world[BroadPhase].index
    for _ in range(int(0.5 * AHEAD)):
        simulation.step()
        agree(simulation.world)
    assert simulation.world[BroadPhase].index is index
    assert not len(index.strays)


@pytest.mark.parametrize("speed", [20.0, 60.0, 300.0])
def test_who_goes_along_in_a_stream_stays_within_them_too(speed: float) -> None:
    """The few whom the others pass are looked up in every step, and met in time."""
    simulation = tumbling(speed, *(gate(x) for x in (15.0, 25.0, 60.0)))
    index, gates, met = simulation.world[BroadPhase].index, {125, 126, 127}, set()
    assert widths(simulation) == pytest.approx(widths(tumbling(0.0)), abs=0.01)
    for _ in range(int(0.5 * AHEAD)):
        simulation.step()
        met |= set(agree(simulation.world).ravel().tolist())
    assert simulation.world[BroadPhase].index is index
    assert set(index.strays.tolist()) <= gates
    assert 125 in met


@pytest.mark.parametrize("others", [[gate(15.0 + x) for x in range(FEW_BESIDE + 1)], [END]])
def test_bounds_do_not_go_along_where_many_stand_or_a_half_space(others: list[dict[str, Any]]) -> None:
    """As seen from the stream these would come on and on; they stay where they are, and who flies is looked up."""
    simulation, met = tumbling(60.0, *others), set()
    for _ in range(8):
        simulation.step()
        met |= set(agree(simulation.world).ravel().tolist())
        assert max(simulation.world[BroadPhase].index.strays, default=0) < 125
    assert 125 in met


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
