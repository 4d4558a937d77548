"""Bodies that attract each other: an evaluation of all pulls by the step's own system, and the error of a tree."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from carom.ecs import Motion, RigidBody, Transform
from carom.ecs.column import Floats
from carom.systems.bodies import centers_of_mass
from carom.systems.forces.mutual_gravitation import MutualGravitation, apply_mutual_gravitation
from carom.systems.gravitation import attract_by_tree
from carom.systems.kernels.gravitation import sum_pairs
from carom.systems.simulation import Simulation
from carom.tools.bench.measure import Figure, figure, timed

FEW, MANY = 2_000, 50_000
REPEATS = 9
SEED = 10


def figures() -> Iterator[Figure]:
    """Time a few pair by pair, and many by the tree, spread evenly and as in a cluster; compare with pair by pair."""
    yield figure(f"pulls of {FEW:,}, pair by pair", "ms", timed(partial(evaluate, world_of(even(FEW))), 31), 10.0, 1e3)
    for name, places in {"even ball": even(MANY), "Plummer's cluster": cluster(MANY)}.items():
        simulation = world_of(places)
        yield figure(f"pulls of {MANY:,}, {name}", "ms", timed(partial(evaluate, simulation), REPEATS), 200.0, 1e3)
        error, drift = errors(simulation)
        for what, value in (("rms", np.sqrt((error**2).mean())), ("99 of 100 below", np.percentile(error, 99.0))):
            yield Figure(f"error, {name}, {what}", "%", 100.0 * value, 100.0 * value, 1.0, "value")
        yield Figure(f"sum of pulls by their sizes, {name}", "1", drift, drift, 1e-12, "value")


def world_of(places: Floats) -> Simulation:
    """Return a world of bodies of 1 kg that attract each other."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), checked=False)
    count = len(places)
    simulation.world.spawn_many(count, Transform(position=places), Motion(), RigidBody(mass=np.ones(count)))
    simulation.force("mutual_gravitation", constant=1.0)
    evaluate(simulation)
    return simulation


def evaluate(simulation: Simulation) -> None:
    """Find all pulls once."""
    with simulation.world.faces(None):  # as within a step
        apply_mutual_gravitation(simulation.world, simulation.settings.dt)


def errors(simulation: Simulation) -> tuple[Floats, float]:
    """Return how far each pull is off, by its size, and the sum of pulls by that of their sizes."""
    world = simulation.world
    rows = world.row_numbers(RigidBody)
    mass, center, exact = world[RigidBody].mass[rows], centers_of_mass(world, rows), np.empty((len(rows), 3))
    law = MutualGravitation(constant=1.0)
    sum_pairs(mass, center, law.constant, law.softening, exact)
    pull, _ = attract_by_tree(mass, center, law.constant, law.softening, law.opening)
    sizes = np.linalg.norm(exact, axis=1)
    return np.linalg.norm(pull - exact, axis=1) / sizes, float(np.linalg.norm(pull.sum(axis=0)) / sizes.sum())


def even(count: int) -> Floats:
    """Return places (m) spread evenly in a ball of 1 m."""
    random = np.random.default_rng(SEED)
    return ways(random, count) * np.cbrt(random.uniform(size=(count, 1)))


def cluster(count: int) -> Floats:
    """Return places (m) in a cluster, denser towards the middle: H. C. Plummer, Monthly Notices of the RAS 71, 1911."""
    random = np.random.default_rng(SEED)
    return ways(random, count) / np.sqrt(random.uniform(0.001, 1.0, (count, 1)) ** (-2.0 / 3.0) - 0.999)


def ways(random: np.random.Generator, count: int) -> Floats:
    """Return directions spread evenly."""
    drawn = random.normal(size=(count, 3))
    return np.asarray(drawn / np.linalg.norm(drawn, axis=1)[:, None])
