"""Render: what pictures of many bodies cost, and whether pictures leave memory behind."""

from __future__ import annotations

import math
import resource
import sys
from collections.abc import Callable, Iterator

import numpy as np

from carom.ecs import Visual
from carom.systems.simulation import Simulation
from carom.tools.bench.measure import Figure, figure, timed
from carom.tools.cameras import Camera
from carom.tools.renderer import Renderer
from carom.tools.scene import Scene

BOX = {"box": {"size": (1.0, 1.0, 1.0)}}
BALL = {"sphere": {"radius": 0.5}}
APART = 1.5  # m between the middles of bodies of 1 m
REPEATS = 15
FIRST, FRAMES, TOLD = 50, 500, 5_000  # frames before memory is looked at, and after; growth is told per so many
BARE = {"shadows": False, "antialiasing": False}


def figures() -> Iterator[Figure]:
    """Yield every part's figures."""
    for part in PARTS.values():
        yield from part()


def thousand() -> Iterator[Figure]:
    """Time pictures of 1,000 boxes and of 1,000 balls, bare and with all that makes them look right."""
    for name, shape, bounds in (("boxes", BOX, (35.0, 75.0)), ("balls", BALL, (math.inf, math.inf))):
        bare, standing = block(1_000, shape), block(1_000, shape, ground=True)
        yield picture_of(f"1,000 {name}, bare", bare, bounds[0], **BARE)
        yield picture_of(f"1,000 {name}, ground, sky, anti-aliasing", standing, bounds[1], shadows=False)
        yield picture_of(f"1,000 {name}, and shadows", standing, math.inf)


def many() -> Iterator[Figure]:
    """Time pictures of 10,000 boxes."""
    yield picture_of("10,000 boxes, bare", block(10_000, BOX), 150.0, **BARE)
    yield picture_of("10,000 boxes, all effects", block(10_000, BOX, ground=True), math.inf)


def memory() -> Iterator[Figure]:
    """Measure by how much the memory of the process grows while pictures, depths and ids are drawn."""
    yield Figure(f"growth in {TOLD:,} pictures", "MB", grown := growth(FRAMES) * TOLD / FRAMES, grown, 10.0, "value")


PARTS: dict[str, Callable[[], Iterator[Figure]]] = {"thousand": thousand, "many": many, "memory": memory}


def block(count: int, shape: object, *, ground: bool = False) -> Simulation:
    """Return a cubic block of bodies with gaps between them, on the ground where stated."""
    simulation = Simulation(checked=False)
    if ground:
        simulation.add(collider={"plane": {}})
    side = np.arange(math.ceil(count ** (1.0 / 3.0) - 1e-9)) * APART
    places = np.stack(np.meshgrid(side, side + APART / 2.0, side, indexing="ij"), axis=-1).reshape(-1, 3)
    simulation.add_many(places[:count], collider=shape, body={})
    return simulation


def picture_of(name: str, simulation: Simulation, bound: float, **effects: bool) -> Figure:
    """Time a picture of 640 x 480 px from where the world is to the array, the first ones excepted."""
    scene, rows = Scene(simulation.world), simulation.world.count(Visual)
    edge = APART * rows ** (1.0 / 3.0)
    camera = Camera((1.2 * edge, 1.1 * edge, 1.6 * edge), (edge / 2.0, edge / 2.0, edge / 2.0))
    with Renderer(640, 480, **effects) as renderer:

        def draw() -> None:
            renderer.picture(scene.batches(), camera)

        draw()
        return figure(name, "ms", timed(draw, REPEATS), bound, 1e3)


def growth(frames: int) -> float:
    """Return by how much the most memory the process ever had (MB) grew in so many frames, after the first."""
    simulation = block(64, BOX, ground=True)
    scene = Scene(simulation.world)
    with Renderer(320, 240) as renderer:
        before = 0.0
        for frame in range(FIRST + frames):
            if frame == FIRST:
                before = most_memory()
            angle = 0.01 * frame
            camera = Camera((3.0 + 12.0 * math.sin(angle), 8.0, 3.0 + 12.0 * math.cos(angle)), (3.0, 3.0, 3.0))
            batches = scene.batches()
            renderer.picture(batches, camera)
            renderer.depth(batches, camera)
            renderer.ids(batches, camera)
    return most_memory() - before


def most_memory() -> float:
    """Return the most memory this process ever had (MB)."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1e6 if sys.platform == "darwin" else 1024.0)
