"""Gravitation of many bodies: pair by pair against the formula, by a tree against pair by pair."""

from __future__ import annotations

import math

import numpy as np
import pytest
from crews import gathered, parts_taken

from carom.ecs import Motion
from carom.ecs.column import Floats
from carom.systems import gravitation
from carom.systems.energy import momentum, total_energy
from carom.systems.gravitation import attract, attract_by_tree
from carom.systems.kernels.gravitation import sum_pairs
from carom.systems.simulation import Simulation

OPENING = 0.6  # the default


def cluster(count: int, seed: int = 1) -> tuple[Floats, Floats]:
    """Return masses (kg) and places (m) as dense in the middle as those of Plummer (Monthly Notices 71, 1911)."""
    random = np.random.default_rng(seed)
    distance = 1.0 / np.sqrt(random.uniform(0.01, 1.0, count) ** (-2.0 / 3.0) - 0.99)
    way = random.normal(size=(count, 3))
    return random.uniform(0.5, 2.0, count), distance[:, None] * way / np.linalg.norm(way, axis=1)[:, None]


def pairs(mass: Floats, center: Floats, softening: float = 0.0) -> tuple[Floats, float]:
    """Return pulls and energy for G = 1, pair by pair however many there are."""
    pull = np.empty((len(mass), 3))
    return pull, sum_pairs(mass, center, 1.0, softening, pull)


@pytest.mark.parametrize(("count", "softening"), [(2, 0.0), (9, 0.0), (61, 0.3)])
def test_every_two_pull_each_other(count: int, softening: float) -> None:
    """G m1 m2 r / (r^2 + s^2)^(3/2), and -G m1 m2 / sqrt(r^2 + s^2), as NumPy sums them; together they pull nobody."""
    mass, center = cluster(count)
    pull, energy = pairs(mass, center, softening)
    gap = center[None] - center[:, None]
    distance = np.sqrt((gap * gap).sum(axis=2) + softening**2)
    np.fill_diagonal(distance, math.inf)
    expected = (mass[:, None, None] * mass[None, :, None] * gap / distance[..., None] ** 3).sum(axis=1)
    assert pull == pytest.approx(expected, rel=1e-12, abs=1e-12)
    assert energy == pytest.approx(-0.5 * (mass[:, None] * mass[None] / distance).sum(), rel=1e-13)
    assert np.abs(pull.sum(axis=0)).max() < 1e-14 * np.abs(pull).sum()


@pytest.mark.parametrize("softening", [0.0, 0.05])
def test_a_tree_pulls_as_pairs_do(softening: float) -> None:
    """Of 3,000 bodies the error is 0.4 % (rms) and below 1 % for 99 of 100; the energy is nearer, the sum is 0."""
    mass, center = cluster(3000)
    exact, depth = pairs(mass, center, softening)
    pull, energy = attract_by_tree(mass, center, 1.0, softening, OPENING)
    errors = np.linalg.norm(pull - exact, axis=1) / np.linalg.norm(exact, axis=1)
    assert math.sqrt((errors**2).mean()) < 0.004
    assert np.percentile(errors, 99.0) < 0.01
    assert energy == pytest.approx(depth, rel=1e-4)
    assert np.abs(pull.sum(axis=0)).max() < 1e-13 * np.abs(pull).sum()


def test_a_smaller_opening_is_nearer_by_its_third_power() -> None:
    """The first part left out is that of third moments, (size / distance)^3 of the pull; at 0 nothing is left out."""
    mass, center = cluster(1000)
    exact, depth = pairs(mass, center)
    scale, errors = np.linalg.norm(exact, axis=1), []
    for opening in (0.6, 0.3):
        pull, _ = attract_by_tree(mass, center, 1.0, 0.0, opening)
        errors.append(float(np.median(np.linalg.norm(pull - exact, axis=1) / scale)))
    assert math.log2(errors[0] / errors[1]) > 2.5
    pull, energy = attract_by_tree(mass, center, 1.0, 0.0, 0.0)
    assert pull == pytest.approx(exact, rel=1e-11, abs=1e-11)
    assert energy == pytest.approx(depth, rel=1e-13)


def test_the_order_of_bodies_and_threads_do_not_matter() -> None:
    """Shuffled bodies are pulled as before, to rounding; leaves shared by three threads give the same bits."""
    mass, center = cluster(1001)
    pull, _ = attract_by_tree(mass, center, 1.0, 0.0, OPENING)
    shuffled = np.random.default_rng(2).permutation(len(mass))
    again, _ = attract_by_tree(mass[shuffled], center[shuffled], 1.0, 0.0, OPENING)
    assert again == pytest.approx(pull[shuffled], rel=1e-12, abs=1e-12)
    with gathered(3) as crew:
        shared, _ = attract_by_tree(mass, center, 1.0, 0.0, OPENING, crew)
        assert parts_taken(crew) == [1, 1]
    assert (shared == pull).all()


def test_bodies_at_one_point_do_not_pull_each_other() -> None:
    """There is no direction there: nothing, not a NaN, whichever way sums are made; softened they have an energy."""
    mass, center = np.ones(20), np.zeros((20, 3))
    center[19, 0] = 2.0
    for way in (attract, attract_by_tree):
        pull, energy = way(mass, center, 1.0, 0.0, OPENING)
        assert pull[19] == pytest.approx((-19.0 / 4.0, 0.0, 0.0), rel=1e-13, abs=1e-15)
        assert pull[0] == pytest.approx((1.0 / 4.0, 0.0, 0.0), rel=1e-13, abs=1e-15)
        assert energy == pytest.approx(-19.0 / 2.0, rel=1e-13)
        softened = way(mass, center, 1.0, 0.5, OPENING)[1]
        assert softened == pytest.approx(-19.0 / math.sqrt(4.25) - 19.0 * 18.0 / 2.0 / 0.5, rel=1e-13)


@pytest.mark.parametrize(("by_pairs", "within"), [(4000, 2e-5), (8, 1e-3)])
def test_a_small_cluster_keeps_energy_and_momentum(
    by_pairs: int, within: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Half a crossing of 40 bodies: verlet keeps the energy of pulls that have one; those of a tree nearly have."""
    monkeypatch.setattr(gravitation, "PAIR_BY_PAIR", by_pairs)
    mass, center = cluster(40)
    simulation = Simulation(dt=1 / 120, gravity=(0.0, 0.0, 0.0), checked=False)
    for weight, place in zip(mass, center, strict=True):
        simulation.add(body={"mass": weight, "inertia": (1.0, 1.0, 1.0)}, transform={"position": place})
    simulation.force("mutual_gravitation", constant=0.02, softening=0.2)
    before = total_energy(simulation.world)
    simulation.step(60)
    assert np.abs(momentum(simulation.world)).max() < 1e-12
    assert total_energy(simulation.world) == pytest.approx(before, rel=within)
    assert np.linalg.norm(simulation.world[Motion].linear, axis=1).max() > 0.3
