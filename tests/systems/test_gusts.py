"""Gusts: what their noise is, by closed forms of its spectrum, and that it depends on seed and time alone."""

from __future__ import annotations

from math import atan, pi

import numpy as np
import pytest

from carom.ecs import Force, Motion, restore_snapshot, state_hash, take_snapshot
from carom.ecs.column import Floats
from carom.systems.forces.gusts import FASTEST, LEAST, MOST, SLOWEST, waves
from carom.systems.free_body import applied
from carom.systems.simulation import Simulation
from carom.systems.why_awake import why_awake


def windy(seed: int = 7, dt: float = 1 / 60) -> tuple[Simulation, int]:
    """Return a ball of 1 kg in a wind with gusts of 3 m/s over 0.5 s."""
    simulation = Simulation(dt=dt, substeps=1, gravity=(0.0, 0.0, 0.0), seed=seed)
    ball = simulation.add(collider={"sphere": {"radius": 0.1}}, body={"mass": 1.0})
    simulation.force("wind", velocity=(5.0, 0.0, -2.0), gust=3.0, gust_time=0.5)
    return simulation, ball


def medium_over(simulation: Simulation, steps: int) -> Floats:
    """Return the velocity of the medium at the one ball (steps, 3)."""
    seen = []
    for _ in range(steps):
        simulation.step()
        seen.append(simulation.world[Force].medium[0].copy())
    return np.array(seen)


def test_gusts_are_what_they_say() -> None:
    """600 time scales: mean, deviation, fourth moment and correlation over 0.3 and 1.2 scales fit the spectrum."""
    simulation, _ = windy(dt=0.15)
    gusts = medium_over(simulation, 2000) - (5.0, 0.0, -2.0)
    assert np.abs(gusts.mean(axis=0)).max() < 0.05 * 3.0
    deviation = gusts.std(axis=0)
    assert deviation == pytest.approx([3.0, 3.0, 3.0], rel=0.08)
    unit = gusts / deviation
    x = np.tan(0.5 * pi * np.linspace(LEAST, MOST, 10_001))  # as much energy between each two
    for steps in (1, 4):
        after = (unit[steps:] * unit[:-steps]).mean(axis=0)
        assert after == pytest.approx([np.cos(0.3 * steps * x).mean()] * 3, abs=0.05)
    assert (unit**4).mean(axis=0) == pytest.approx([3.0, 3.0, 3.0], abs=0.5)
    assert np.abs(unit.T @ unit / len(unit) - np.eye(3)).max() < 0.17


def test_waves_share_the_energy_evenly() -> None:
    """Wave k has its rate in the k-th part of the spectrum; no two winds or seeds have the same."""
    rates, phases = waves(3, 0)
    share = (2.0 / pi * np.arctan(rates) - LEAST) / (MOST - LEAST) * rates.shape[1]
    assert np.floor(share).tolist() == [list(range(rates.shape[1]))] * 3
    assert SLOWEST <= rates.min() < rates.max() <= FASTEST
    assert pytest.approx((2.0 / pi * atan(SLOWEST), 2.0 / pi * atan(FASTEST)), rel=1e-15) == (LEAST, MOST)
    assert 0.0 <= phases.min() < phases.max() < 2.0 * pi
    for seed, number in ((3, 1), (4, 0)):
        assert not np.isin(waves(seed, number)[0], rates).any()


def test_gusts_depend_on_seed_and_time_alone() -> None:
    """The same seed blows the same to the bit, whatever the frames and wherever one goes on from; another does not."""
    simulation, ball = windy()
    simulation.force("quadratic_drag", area=0.1)
    simulation.step(20)
    kept = take_snapshot(simulation.world)
    simulation.step(40)
    reached = state_hash(simulation.world)
    restore_snapshot(simulation.world, kept)
    for _ in range(4):
        simulation.advance(10 / 60)
    assert (simulation.frame, state_hash(simulation.world)) == (60, reached)
    for seed, same in ((7, True), (8, False)):
        other, _ = windy(seed)
        other.force("quadratic_drag", area=0.1)
        other.step(60)
        assert (state_hash(other.world) == reached) is same
    assert np.linalg.norm(simulation[ball].motion.linear) > 0.1


def test_two_winds_gust_apart_and_none_gusts_without_saying_so() -> None:
    """Gusts of two winds add up like independent noise; a plain wind is even to the bit."""
    simulation, _ = windy()
    single = medium_over(simulation, 200)
    simulation, _ = windy()
    simulation.force("wind", velocity=(0.0, 0.0, 0.0), gust=3.0, gust_time=0.5)
    other = medium_over(simulation, 200) - single
    assert np.abs(np.corrcoef(single[:, 0], other[:, 0])[0, 1]) < 0.5
    even = Simulation()
    even.add(body={"mass": 1.0})
    even.force("wind", velocity=(5.0, 0.0, -2.0))
    even.step(3)
    assert even.world[Force].medium[0].tolist() == [5.0, 0.0, -2.0]


def test_who_is_in_a_gust_stays_awake_and_drags_see_it() -> None:
    """A crate on the ground never sleeps in gusts, and sleeps after their window; the list of forces shows drag."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(collider={"plane": {}})
    crate = simulation.add(
        name="crate", collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={"mass": 50.0},
        transform={"position": (0.0, 0.5, 0.0)},
    )  # fmt: skip
    simulation.force("wind", velocity=(5.0, 0.0, 0.0), gust=1.0, gust_time=2.0, during=(0.0, 2.0))
    simulation.force("quadratic_drag", area=1.0, drag_coefficient=1.0)
    simulation.step(119)
    drag = next(part for part in applied(simulation) if "quadratic drag" in part.name).force[0]
    through = simulation.world[Force].medium[simulation.world.row(crate)]
    assert drag == pytest.approx(0.5 * 1.225 * np.linalg.norm(through) * through, rel=0.05)
    assert why_awake(simulation, "crate") == "'crate' is awake since it is pushed another way in every step, by wind"
    simulation.step(60)
    assert bool(simulation.world[Motion].asleep[simulation.world.row(crate)])
