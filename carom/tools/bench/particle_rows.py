"""Particles: a step of a million, through the scheduled systems of a world file, beside what the memory alone takes."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import inf

import numpy as np

from carom.ecs.relations.particle import Particle
from carom.systems.kernels.kernel import kernel
from carom.systems.simulation import Simulation
from carom.tools.bench.measure import Figure, figure, timed
from carom.worlds.builder import load_text

MILLION = 1_000_000
BOUND = 6.0  # ms
REPEATS = 31
WORLD = """carom: 1
step: {{dt: 1/60, threads: 1}}
entities:
  - {{name: ground, collider: {{plane: {{}}}}, material: {{restitution: 0.5, friction: 0.4}}}}
  - name: cloud
    emitter: {emitter}
    material: {{friction: 0.4}}
    transform: {{position: [0, 4, 0]}}
forces:
  - {force}
"""
BURST = "{burst: 1000000, source: {sphere: {radius: 3 m}}, cone: 180 deg, speed: [0, 2], life: 1 h, mass: 1 g}"
STREAM = "{rate: 500000, source: {sphere: {radius: 3 m}}, cone: 180 deg, speed: [0, 2], life: 2 s, mass: 1 g}"
LINEAR, QUADRATIC = "linear_drag: {coefficient: 0.0002}", "quadratic_drag: {area: 1 cm2}"
#: Steps after which they are measured: none has come down yet, some bounce, most lie.
MOMENTS = {"falling": 5, "bouncing": 60, "lying": 400}


@kernel("state")
def pass_over(state, dies):  # type: ignore[no-untyped-def]
    """Read and write as many bytes as a step does at least, and count what is due as the deaths do."""
    for i in range(len(state)):
        state[i] = -state[i]
    due = 0
    for i in range(len(dies)):
        due += dies[i] <= 0.0
    return due


def figures() -> Iterator[Figure]:
    """Time the memory, then a cloud that falls, bounces and comes to lie, and a stream of births and deaths."""
    yield figure(f"memory of {MILLION:,} alone", "ms", timed(memory(), REPEATS), inf, 1e3)
    for name, force in (("linear drag", LINEAR), ("quadratic drag", QUADRATIC)):
        simulation = flying(BURST, force)
        for moment, steps in MOMENTS.items():
            simulation.step(steps - simulation.frame)
            bound = inf if name == "quadratic drag" and moment != "falling" else BOUND
            yield figure(f"{MILLION:,} particles, {name}, {moment}", "ms", timed(simulation.step, REPEATS), bound, 1e3)
    simulation = flying(STREAM, LINEAR)
    simulation.step(125)
    title = f"{simulation.world.count(Particle):,} born and dying, 8,333 a step"
    yield figure(title, "ms", timed(simulation.step, REPEATS), inf, 1e3)


def flying(emitter: str, force: str) -> Simulation:
    """Return the world of the file, unchecked, after its first step."""
    simulation = load_text(WORLD.format(emitter=emitter, force=force), checked=False).simulation
    simulation.step()
    return simulation


def memory() -> partial[int]:
    """Return a pass over the bytes of a step: 24 each of place and velocity, and the 8 of the time of death."""
    return partial(pass_over, np.ones(6 * MILLION, np.float32), np.ones(MILLION))
