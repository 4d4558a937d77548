"""Meshes: what 500 bodies on 20,000 triangles cost to measure, and what FCL takes for the same pairs."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion
from carom.systems.detection.fcl_pairs import measure_by_fcl
from carom.systems.detection.meshes import tree_of
from carom.systems.detection.narrow import Points, measure_pairs
from carom.systems.kernels.reduction import MOST_POINTS
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.land import land
from carom.systems.simulation import Simulation
from carom.tools.bench.measure import Figure, figure, timed

BODIES, CELLS = 500, 100  # 2 triangles a cell
WIDTH, ROUGH = 100.0, 0.3  # m
SHAPES = ({"box": {"size": (1.0, 1.0, 1.0)}}, {"sphere": {"radius": 0.5}}, {"capsule": {"radius": 0.3, "length": 0.8}})
SETTLING = 60  # steps after which they lie on the land
REACH = 0.01  # m
REPEATS, BY_FCL = 25, 3


def figures() -> Iterator[Figure]:
    """Yield the time to build the tree, the narrow phase's with its searches of the tree, and FCL's."""
    heights = np.random.default_rng(0).uniform(0.0, ROUGH, (CELLS + 1, CELLS + 1))
    geometry = land(heights, WIDTH / CELLS, WIDTH / CELLS, "bench")
    triangles = f"{len(geometry.faces):,} triangles"
    yield figure(f"tree over {triangles}", "ms", timed(lambda: tree_of(geometry), 5), 50.0, 1e3)
    simulation, pairs, reaches = _lying(geometry)
    name, world = f"{BODIES} bodies on {triangles}", simulation.world
    with world.faces(None):  # as within a system: else kernels are handed copies of columns
        yield figure(name, "ms", timed(lambda: measure_pairs(world, pairs, reaches), REPEATS), 1.5, 1e3)
        points, which = Points(BODIES, MOST_POINTS * BODIES), np.arange(BODIES)
        by_fcl = timed(lambda: measure_by_fcl(world, which, pairs, reaches, points), BY_FCL)
        yield figure(f"{name}, FCL", "ms", by_fcl, inf, 1e3)


def _lying(geometry: Geometry) -> tuple[Simulation, Integers, Floats]:
    """Return bodies that lie on land, and their pairs with it and reaches."""
    simulation = Simulation()
    simulation.add(collider={"shape": HeightField(geometry)})
    generator = np.random.default_rng(1)
    for k in range(BODIES):
        x, z = generator.uniform(-0.45 * WIDTH, 0.45 * WIDTH, 2)
        turn = quaternion.from_axis_angle((0.0, 1.0, 0.0), generator.uniform(0.0, np.pi))
        place = {"position": (x, 0.6 + ROUGH, z), "rotation": turn}
        simulation.add(collider=SHAPES[k % len(SHAPES)], body={}, transform=place)
    simulation.step(SETTLING)
    pairs = np.stack([np.zeros(BODIES, np.int64), np.arange(1, 1 + BODIES)], axis=1)
    return simulation, pairs, np.full(BODIES, REACH)
