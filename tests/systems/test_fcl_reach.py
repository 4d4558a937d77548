"""FCL is asked about pairs that may touch within their reach, and not about whom a kernel has found farther apart."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from pairs import SHAPES, turns

from carom.ecs import Collider
from carom.systems.detection.answered import Answered
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.fcl_pairs import near_enough
from carom.systems.detection.narrow import measure_pairs
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation

ROUND = (Cylinder(radius=0.4, length=0.9), Cone(radius=0.5, length=0.8), Ellipsoid(radii=(0.3, 0.6, 0.4)))
SOLIDS = [*ROUND, *(shape for shape in SHAPES.values() if not isinstance(shape, Mesh))]


@pytest.mark.parametrize("reach", [0.001, 0.05, 0.4])
@pytest.mark.parametrize("seed", range(3))
def test_who_is_not_asked_about_has_no_points(seed: int, reach: float) -> None:
    """In random poses, whichever way round, and FCL is asked of hardly any in vain; half of all are out of reach."""
    simulation, random = Simulation(), np.random.default_rng(seed)
    for shape in SOLIDS * 8:
        place = {"position": random.uniform(-1.5, 1.5, 3), "rotation": turns(random)}
        simulation.add(collider={"shape": shape}, transform=place, visual=False)
    world = simulation.world
    numbers = {shape.number for shape in ROUND}
    rows = combinations(range(len(SOLIDS) * 8), 2)
    pairs = np.array([pair for pair in rows if numbers & set(world[Collider].shape[list(pair)].tolist())])
    with world.faces(None):
        reach_within(world, 1 / 60)
        which, reaches = np.arange(len(pairs)), np.full(len(pairs), reach)
        asked = set(near_enough(world, which, pairs, reaches).tolist())
        assert set(near_enough(world, which, pairs[:, ::-1].copy(), reaches).tolist()) == asked
        found = measure_pairs(world, pairs, reaches, "fcl")
        before = world[Answered].fcl
        again = measure_pairs(world, pairs, reaches)
    touching = {*zip(found.row_a.tolist(), found.row_b.tolist(), strict=True)}
    near = {p for p, pair in enumerate(pairs.tolist()) if tuple(pair) in touching}
    assert near <= asked
    assert len(asked) <= 1.05 * len(near)
    assert 0 < len(near) < 0.5 * len(pairs)
    assert world[Answered].fcl - before == len(asked)
    for column, same in zip(found, again, strict=True):
        assert np.array_equal(column, same)
