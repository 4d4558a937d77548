"""Emission: how many particles are born, when, where and how fast, how they die, and the table they stand in."""

from __future__ import annotations

from math import pi, sqrt
from typing import Any

import numpy as np
import pytest
from sprays import emitting, positions, velocities

from carom.ecs import restore_snapshot, state_hash, take_snapshot
from carom.ecs.components.emitter import Emitter
from carom.ecs.relations.particle import Particle
from carom.systems.simulation import Simulation

G = 9.81
SINGLE = 2e-6  # relative, of a few roundings of float32


@pytest.mark.parametrize("dt", [1 / 240, 1 / 60, 1 / 37, 0.1])
def test_as_many_are_born_as_rate_and_time_say(dt: float) -> None:
    """1234 per second for 2.5 s are 3085, whatever the step."""
    simulation = emitting(dt=dt, rate=1234.0, duration=2.5, life=100.0)
    while simulation.time < 2.5:
        simulation.step()
    simulation.step(3)
    assert simulation["source"].emitter.born == simulation.world.count(Particle) == 3085


def test_jittered_frames_bear_the_same_particles() -> None:
    """Frames of any lengths add up to the same steps: 3085, each with the same bits."""
    even = emitting(rate=1234.0, duration=2.5, life=100.0, speed=(3.0, 5.0), cone=0.5)
    jittered = emitting(rate=1234.0, duration=2.5, life=100.0, speed=(3.0, 5.0), cone=0.5)
    random = np.random.default_rng(1)
    while jittered.time < 2.6:
        jittered.advance(random.uniform(0.0, 0.04))
    even.step(jittered.frame)
    assert len(positions(jittered)) == 3085
    assert (positions(jittered) == positions(even)).all()


def test_each_is_born_at_its_own_time() -> None:
    """Rising freely at 3 m/s, the n-th of 50 a second left (n + 1/2) / 50 s after the start, inside of any step."""
    simulation = emitting(dt=0.1, rate=50.0, life=100.0, speed=3.0)
    simulation.step(4)
    age = 0.4 - (np.arange(20) + 0.5) / 50.0
    assert np.sort(positions(simulation)[:, 1])[::-1] == pytest.approx(
        np.sort(3.0 * age - 0.5 * G * age**2)[::-1], rel=SINGLE, abs=1e-7
    )


def test_bursts_come_at_their_times() -> None:
    """100 at 0.25 s and every 0.5 s after that, for 1.1 s: three bursts."""
    simulation = emitting(dt=1 / 60, burst=100, start=0.25, every=0.5, duration=1.1, life=100.0)
    counts = []
    for _ in range(120):
        simulation.step()
        counts.append(simulation.world.count(Particle))
    births = {round(frame / 60, 4): born for frame, born in enumerate(np.diff([0, *counts]).tolist()) if born}
    assert births == {0.25: 100, 0.75: 100, 1.25: 100}


def test_they_live_as_long_as_they_are_said_to() -> None:
    """A fountain holds rate x life particles, those born in the last second."""
    simulation = emitting(rate=480.0, life=1.0, dt=1 / 120)
    simulation.step(300)
    assert simulation.world.count(Particle) == 480
    assert simulation["source"].emitter.born == 1200


def test_the_oldest_make_room() -> None:
    """With at most 100 alive, these are the last 100."""
    simulation = emitting(rate=1000.0, life=100.0, most=100)
    simulation.step(240)
    numbers = simulation.world[Particle].number[: simulation.world.count(Particle)]
    assert sorted(numbers.tolist()) == list(range(900, 1000))


def test_they_die_where_they_leave_their_part_of_space() -> None:
    """Thrown up at 5 m/s into a box 1 m high: those who live are those that are in it."""
    box = {"box": {"size": (1.0, 1.0, 1.0), "position": (0.0, 0.5, 0.0)}}
    simulation = emitting(dt=1 / 120, rate=1200.0, life=100.0, speed=5.0, within=box)
    simulation.step(60)
    rise = (5.0 - sqrt(25.0 - 2.0 * G)) / G  # to 1 m
    assert simulation.world.count(Particle) == pytest.approx(1200.0 * rise, abs=11)  # ten are born in a step
    assert positions(simulation)[:, 1].max() <= 1.0


def test_particles_leave_with_the_velocity_of_a_body_that_spins() -> None:
    """Born 0.5 m off the axis of a body that flies at 3 m/s and turns at 4 rad/s: v + w x r, straight from there."""
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    motion = {"linear": (3.0, 0.0, 0.0), "angular": (0.0, 4.0, 0.0)}
    wheel = simulation.add(name="wheel", body={"mass": 1.0, "inertia": (1.0, 1.0, 1.0)}, motion=motion)
    simulation.add(emitter={"rate": 60.0, "life": 100.0}, parent={"entity": int(wheel), "position": (0.5, 0.0, 0.0)})
    simulation.step(240)
    born = (np.arange(60) + 0.5) / 60.0
    rim = 0.5 * np.stack([np.cos(4.0 * born), 0.0 * born, -np.sin(4.0 * born)], axis=1)
    spin = 2.0 * np.stack([-np.sin(4.0 * born), 0.0 * born, -np.cos(4.0 * born)], axis=1)
    velocity = np.array((3.0, 0.0, 0.0)) + spin
    expected = np.array((3.0, 0.0, 0.0)) * born[:, None] + rim + velocity * (1.0 - born)[:, None]
    order = np.argsort(simulation.world[Particle].number[:60])
    assert velocities(simulation)[order] == pytest.approx(velocity, abs=2e-4)
    assert positions(simulation)[order] == pytest.approx(expected, abs=3e-4)


def test_directions_fill_the_cone_evenly() -> None:
    """Within 60 degrees of x the cosine is even in [1/2, 1], and all directions across come alike."""
    words = {"burst": 20_000, "direction": (2.0, 0.0, 0.0), "cone": pi / 3, "speed": 1.0, "life": 100.0}
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    simulation.add(emitter=words)
    simulation.step()
    cosine = velocities(simulation)[:, 0]
    assert cosine.min() >= 0.5 - 1e-6
    assert np.histogram(cosine, 10, (0.5, 1.0))[0] == pytest.approx(2000.0, abs=200)
    assert velocities(simulation).mean(axis=0) == pytest.approx((0.75, 0.0, 0.0), abs=0.01)


@pytest.mark.parametrize(
    ("source", "square"),
    [
        ({"sphere": {"radius": 2.0}}, 0.6 * 4.0),
        ({"disc": {"radius": 2.0}}, 0.5 * 4.0),
        ({"box": {"size": (2.0, 4.0, 6.0)}}, (4.0 + 16.0 + 36.0) / 12.0),
    ],
)
def test_births_fill_their_source_evenly(source: dict[str, Any], square: float) -> None:
    """The mean square of the distance is that of the shape: 3/5 r^2 of a ball, 1/2 r^2 of a disc, edges^2 / 12."""
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    simulation.add(emitter={"burst": 20_000, "source": source, "life": 100.0})
    simulation.step()
    place = positions(simulation)
    assert place.mean(axis=0) == pytest.approx((0.0, 0.0, 0.0), abs=0.04)
    assert (place**2).sum(axis=1).mean() == pytest.approx(square, rel=0.02)


def test_a_snapshot_leads_to_the_same_bits() -> None:
    """Restored in the middle of births, deaths and bounces of three emitters, the future is the same."""
    simulation = emitting(dt=1 / 60, rate=300.0, life=(0.1, 0.7), speed=(2.0, 3.0), cone=1.0, floor={"friction": 0.2})
    for x in (1.0, 2.0):
        words = {"rate": 200.0, "life": (0.2, 0.5), "speed": 2.0, "most": 50, "collide": "all"}
        simulation.add(emitter=words, transform={"position": (x, 0.5, 0.0)})
    simulation.step(45)
    saved = take_snapshot(simulation.world)
    simulation.step(45)
    expected = state_hash(simulation.world)
    restore_snapshot(simulation.world, saved)
    simulation.step(45)
    assert state_hash(simulation.world) == expected


def test_rows_of_an_emitter_stay_together() -> None:
    """Whoever is born and dies, pieces stand in order of emitters, and nobody is lost or there twice."""
    simulation = Simulation(dt=1 / 60)
    for rate in (50.0, 400.0, 7.0, 90.0):
        simulation.add(emitter={"rate": rate, "life": (0.05, 0.8)}, transform={"position": (rate, 0.0, 0.0)})
    for _ in range(60):
        simulation.step()
        count = simulation.world.count(Particle)
        table = simulation.world[Particle]
        assert (np.diff(table.emitter[:count]) >= 0).all()
        pairs = np.stack([table.emitter[:count], table.number[:count]], axis=1)
        assert len(np.unique(pairs, axis=0)) == count
        assert (table.dies[:count] > simulation.time).all()
        assert (table.x[:count] == np.array((50.0, 400.0, 7.0, 90.0))[table.emitter[:count]]).all()


def test_particles_go_with_their_emitter() -> None:
    """Of who is despawned, or emits no more, none are left after the next step, and others stay."""
    simulation = emitting(dt=1 / 60, burst=30, life=100.0)
    former = simulation.add(emitter={"burst": 10, "life": 100.0})
    other = simulation.add(emitter={"burst": 20, "life": 100.0})
    simulation.step(2)
    simulation.world.despawn(simulation.world.find("source"))
    simulation.world.detach(former, Emitter)
    simulation.step()
    assert simulation.world.count(Particle) == 20
    assert (simulation.world[Particle].emitter[:20] == int(other)).all()


def test_another_seed_is_another_spray() -> None:
    """The world's seed decides the numbers drawn; of two emitters they differ as well."""
    sprays = []
    for seed in (0, 0, 1):
        simulation = Simulation(dt=1 / 60, seed=seed)
        for _ in range(2):
            simulation.add(emitter={"burst": 50, "speed": 1.0, "cone": 3.0, "life": 100.0})
        simulation.step()
        sprays += [velocities(simulation)[:50], velocities(simulation)[50:]]
    assert (sprays[0] == sprays[2]).all()
    assert (sprays[1] == sprays[3]).all()
    assert not (sprays[0] == sprays[1]).any()
    assert not (sprays[0] == sprays[4]).any()
