"""Break: what a break of pool costs to simulate, record, photograph and film."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from statistics import median

from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.bench.measure import Figure, Timing, figure, timed
from carom.tools.film import Film
from carom.tools.filming import shot_of
from carom.tools.recorder import Recorder
from carom.tools.renderer import Renderer
from carom.tools.scene import Scene
from carom.worlds.builder import LoadedWorld, load_world

WORLD = "billiards"
SECONDS = 4.0  # of the break, in which nearly all that costs happens
FILM_SECONDS, FILM_RATE = 10, 30


def figures() -> Iterator[Figure]:
    """Time each on its own."""
    load_world(WORLD).simulation.step()  # kernels from the cache
    yield _real_time()
    yield _recording()
    yield _one_ball()
    yield from _pictures()


def _steps(loaded: LoadedWorld) -> int:
    return round(SECONDS / loaded.simulation.settings.dt)


def _real_time() -> Figure:
    def play() -> None:
        loaded = load_world(WORLD)
        loaded.simulation.step(_steps(loaded))

    timing = timed(play, 5)
    name = f"{WORLD}, dt 1/240, one thread"
    return Figure(name, "x real time", SECONDS / timing.wall, SECONDS / timing.cpu, 10.0, "cpu", True, timing.repeats)


def _recording() -> Figure:
    _recorded(1)  # Rerun imports much of itself when it first writes
    walls, cpus, steps, frames = [], [], 0, 0
    for _ in range(3):
        plain = load_world(WORLD)
        steps = _steps(plain)
        without = timed(partial(plain.simulation.step, steps), 1)
        having, frames = _recorded(steps)
        walls.append(1e3 * (having.wall - without.wall) / frames)
        cpus.append(1e3 * (having.cpu - without.cpu) / frames)
    return Figure("recording, 60 frames a second", "ms a frame", median(walls), median(cpus), 1.0, "cpu", repeats=3)


def _recorded(steps: int) -> tuple[Timing, int]:
    """Time steps with a recorder; return also how many frames it recorded."""
    simulation = load_world(WORLD).simulation
    with tempfile.TemporaryDirectory() as folder:
        recorder = Recorder(Path(folder) / "run.rrd")
        with observed(simulation, recorder):
            timing = timed(partial(simulation.step, steps), 1)
    return timing, recorder.frames


def _one_ball() -> Figure:
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    simulation.add(transform={"position": (0.0, 0.1, 0.0)}, collider={"sphere": {"radius": 0.1}}, body={})
    simulation.step(60)
    timing = timed(lambda: simulation.step(200), 9)
    return figure("one ball on a plane", "ms a step", timing, 0.3, 1e3 / 200)


def _pictures() -> Iterator[Figure]:
    loaded = load_world(WORLD)
    loaded.simulation.step(240)
    scene, camera = Scene(loaded.simulation.world), shot_of(loaded).camera(loaded.simulation.world)
    with Renderer(640, 480) as renderer, tempfile.TemporaryDirectory() as folder:
        renderer.picture(scene.batches(), camera)
        timing = timed(lambda: renderer.picture(scene.batches(), camera), 9)
        yield Figure("picture 640 x 480, warm", "ms", 1e3 * timing.wall, 1e3 * timing.cpu, 60.0, repeats=9)

        def film() -> None:
            with Film(Path(folder) / "film.mp4", 640, 480, FILM_RATE) as strip:
                for _ in range(FILM_SECONDS * FILM_RATE):
                    strip.add(renderer.picture(scene.batches(), camera))
                    loaded.simulation.step()

        timing = timed(film, 1)
        yield Figure(f"film of {FILM_SECONDS} s at {FILM_RATE} fps", "s", timing.wall, timing.cpu, 30.0)
