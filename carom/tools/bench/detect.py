"""Detect: array kernels against FCL, in alternation on one thread, ratios of CPU time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from carom.ecs import ColliderPose, World
from carom.ecs.column import Floats
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.broad import BroadPhase, overlapping
from carom.systems.simulation import Simulation
from carom.tools.bench import fcl_rows, hull_rows, mesh_rows, narrow_rows
from carom.tools.bench.measure import Figure, compared, figure

SPACING, JITTER = 0.91, 0.15  # of balls of 1 m: 7 of their bounds overlap each, as in a pile
REPEATS = 7


def figures() -> Iterator[Figure]:
    """Yield every part's figures."""
    for part in PARTS.values():
        yield from part()


def broad_phase() -> Iterator[Figure]:
    """Compare with FCL's manager, which keeps its tree, calls Python for every pair and makes a list of them."""
    world = pile(10_000)
    manager = fcl_manager(world[ColliderPose])

    def by_fcl() -> None:
        manager.update()
        manager.collide([], gather)

    for state, ours, calls, bound in (("cold", find_cold, 5, 12.0), ("settled", find, 25, 60.0)):
        ratio = compared(by_fcl, partial(ours, world), REPEATS, calls)
        yield figure(f"broad phase, 10,000 balls, {state}", "x faster than FCL", ratio, bound, at_least=True)


def broad_phase_growth() -> Iterator[Figure]:
    """Compare cold detections of 10,000 and of 50,000 bodies of one density."""
    few, many = pile(10_000), pile(50_000)
    ratio = compared(partial(find_cold, many), partial(find_cold, few), REPEATS, 5)
    yield figure("broad phase, 10,000 to 50,000 balls, cold", "x the count", ratio, 1.15, 1.0 / 5.0)


def pile(count: int) -> World:
    """Return balls packed as in a pile, placed for detection."""
    edge = int(np.ceil(count ** (1 / 3)))
    cells = np.stack(np.unravel_index(np.arange(count), (edge, edge, edge)), axis=1)
    places = SPACING * cells + np.random.default_rng(1).uniform(-JITTER, JITTER, (count, 3))
    simulation = Simulation(checked=False)
    simulation.add_many(places, collider={"sphere": {"radius": 0.5}}, body={}, visual=False)
    world = simulation.world
    with world.faces(None):
        reach_within(world, simulation.settings.dt)
    find_cold(world)
    return world


def find(world: World) -> None:
    """Find the pairs, with what the cache knows."""
    with world.faces(None):
        overlapping(world)


def find_cold(world: World) -> None:
    """Find the pairs from nothing."""
    world[BroadPhase].drop()
    find(world)


def fcl_manager(pose: Any) -> Any:
    """Return FCL's manager with a ball for every collider, of the same bounds."""
    import fcl

    centers: Floats = 0.5 * (pose.lower + pose.upper)
    radii = 0.5 * (pose.upper - pose.lower)[:, 0]
    held = [(center, radius) for center, radius in zip(centers, radii, strict=True) if radius > 0.0]
    manager = fcl.DynamicAABBTreeCollisionManager()
    manager.registerObjects([fcl.CollisionObject(fcl.Sphere(r), fcl.Transform(c)) for c, r in held])
    manager.setup()
    return manager


def gather(one: Any, two: Any, pairs: list[Any]) -> bool:
    """Keep a pair and go on."""
    pairs.append((one, two))
    return False


PARTS: dict[str, Callable[[], Iterator[Figure]]] = {
    "broad_phase": broad_phase,
    "broad_phase_growth": broad_phase_growth,
    "narrow_phase": narrow_rows.figures,
    "hulls": hull_rows.figures,
    "meshes": mesh_rows.figures,
    "fcl": fcl_rows.figures,
}
