"""Race: one scene stepped by all engines in turns, so that what else the machine does meets all alike."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from importlib.util import find_spec
from math import inf
from statistics import fmean, median

from carom.tools.bench.contact_scenes import Scene
from carom.tools.bench.engines import ENGINES, Engine
from carom.tools.bench.measure import By, Figure, Timing, timed

OURS = "carom"
TURN = 10  # steps of one engine before it is another's turn: the first of them find a cold cache


def race(
    name: str, scene: Scene, peers: Sequence[str], ratio: float, threads: int = 1
) -> Generator[Figure, None, dict[str, Engine]]:
    """Yield what a step takes each engine that is installed, and us by each; return the engines as they are then.

    Time by that of ``peers``, once all has settled, is at most ``ratio``: of the processor, of more threads than one on
    the wall. What falls meets all at once before that, which the mean from the start tells.
    """
    there = {engine: make for engine, make in ENGINES.items() if engine == OURS or find_spec(engine)}
    found = {engine: make(scene, threads) for engine, make in there.items()}
    taken = dict(zip(found, stepped(list(found.values()), scene.steps), strict=True))
    times = {engine: settled(timings) for engine, timings in taken.items()}
    ours = times[OURS]
    by: By = "cpu" if threads == 1 else "wall"
    for engine, theirs in times.items():
        yield Figure(
            f"{name}, {engine}", "ms a step", 1e3 * theirs.wall, 1e3 * theirs.cpu, inf, by, repeats=theirs.repeats
        )
        if engine != OURS:
            wall, cpu = ours.wall / theirs.wall, ours.cpu / theirs.cpu
            bound = ratio if engine in peers else inf
            yield Figure(f"{name}, {OURS} by {engine}", "x", wall, cpu, bound, by, repeats=ours.repeats)
    for engine, timings in taken.items():  # all steps but the first, in which much is loaded
        mean = 1e3 * fmean(timing.cpu if by == "cpu" else timing.wall for timing in timings[1:])
        yield Figure(f"{name}, {engine}, mean from the start", "ms a step", mean, mean, inf, "value")
    return found


def stepped(engines: list[Engine], steps: int) -> list[list[Timing]]:
    """Step all, in turns; return what each step took each."""
    taken: list[list[Timing]] = [[] for _ in engines]
    for first in range(0, steps, TURN):
        for engine, timings in zip(engines, taken, strict=True):
            timings.extend(timed(engine.step, 1) for _ in range(min(TURN, steps - first)))
    return taken


def settled(timings: list[Timing]) -> Timing:
    """Return the median of the last third of the steps, when most of what falls has settled."""
    tail = timings[-(len(timings) // 3) :]
    return Timing(median(t.wall for t in tail), median(t.cpu for t in tail), len(tail))
