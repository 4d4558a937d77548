"""Contacts: whole scenes against other engines, in turns, with what they got beside what they took."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from math import inf

import numpy as np

from carom.tools.bench import contact_scenes as scenes
from carom.tools.bench.contact_scenes import Scene
from carom.tools.bench.engines import ENGINES, Engine
from carom.tools.bench.measure import Figure, figure, timed, timed_process
from carom.tools.bench.overlap import lost, mean_overlap
from carom.tools.bench.race import OURS, race

PEERS = ("rapier3d",)
READ, READS = 10_000, 101
FIRST_STEP = """
from carom.systems.simulation import Simulation
simulation = Simulation()
simulation.add(collider={"plane": {}})
for k in range(3):
    box = {"box": {"size": (1.0, 1.0, 1.0)}}
    simulation.add(collider=box, body={}, transform={"position": (0.0, 0.5 + k, 0.0)})
simulation.step()
"""


@dataclass(frozen=True)
class Row:
    """A scene and its bounds: time by rapier3d's, mean overlap, and how far a body may stray from its start.

    Time is that of the processor, of more threads than one that on the wall.
    """

    scene: Callable[[], Scene]
    ratio: float
    overlap: float = inf  # m
    drift: float = inf  # m
    threads: int = 1


ROWS = {
    "sphere_pile_1000": Row(partial(scenes.sphere_pile, 1000), 0.9, overlap=0.003),
    "sphere_pile_10000": Row(partial(scenes.sphere_pile, 10_000), 0.7, overlap=0.006),
    "box_pile_1000": Row(partial(scenes.box_pile, 1000), 1.0, overlap=0.002),
    "box_pile_4000": Row(partial(scenes.box_pile, 4000), 1.0, overlap=0.002),
    "pyramid_40": Row(partial(scenes.pyramid, 40), 1.0, drift=0.12),
    "terrain_500": Row(partial(scenes.terrain, 500), 1.5),
    "free_flight_10000": Row(partial(scenes.free_flight, 10_000), 0.12),
    "sphere_pile_10000_two_threads": Row(partial(scenes.sphere_pile, 10_000), 1.0, overlap=0.006, threads=2),
    "box_pile_4000_two_threads": Row(partial(scenes.box_pile, 4000), 1.4, overlap=0.002, threads=2),
}


def figures() -> Iterator[Figure]:
    """Yield every part's figures."""
    for part in PARTS.values():
        yield from part()


def compare(name: str) -> Iterator[Figure]:
    """Step a scene by all engines that are installed, and tell what each took and what became of the bodies."""
    row, scene = ROWS[name], ROWS[name].scene()
    found = yield from race(name, scene, PEERS, row.ratio, row.threads)
    for engine, stood in found.items():
        yield from quality(f"{name}, {engine}", row, scene, stood, bounded=engine == OURS)


def quality(name: str, row: Row, scene: Scene, engine: Engine, *, bounded: bool) -> Iterator[Figure]:
    """Yield what became of the bodies; only ours is bounded."""
    position, rotation = engine.poses()
    away = float(np.linalg.norm(position - scene.position, axis=1).max())
    told: list[tuple[str, str, float, float]] = []
    if row.overlap < inf:
        told.append(("mean overlap", "mm", 1e3 * mean_overlap(scene, position, rotation), 1e3 * row.overlap))
    if row.drift < inf:
        told.append(("farthest from its start", "m", away, row.drift))
    if scene.walls or scene.land is not None:
        told.append(("lost", "bodies", float(lost(scene, position)), 0.0))
    for what, unit, value, bound in told:
        yield Figure(f"{name}, {what}", unit, value, value, bound if bounded else inf, "value")


def read_poses() -> Iterator[Figure]:
    """Time copying the poses of all bodies out of a world, and out of the peers."""
    scene = scenes.free_flight(READ)
    for name in (OURS, *PEERS):
        engine = ENGINES[name](scene, 1)
        engine.step()
        bound = 0.05 if name == OURS else inf
        yield figure(f"reading {READ:,} poses, {name}", "ms", timed(engine.poses, READS), bound, 1e3)


def first_step() -> Iterator[Figure]:
    """Time a process from its start to the end of a small world's first step, with kernels in the cache."""
    command = [sys.executable, "-c", FIRST_STEP]
    as_installed = {"PYTHONDONTWRITEBYTECODE": ""}  # Python keeps what it makes of sources, unless told not to
    timed_process(command, 1, as_installed)
    timing = timed_process(command, 5, as_installed)
    yield Figure("second start until the first step", "s", timing.wall, timing.cpu, 2.0, repeats=timing.repeats)


PARTS: dict[str, Callable[[], Iterator[Figure]]] = {
    **{name: partial(compare, name) for name in ROWS},
    "read_poses": read_poses,
    "first_step": first_step,
}
