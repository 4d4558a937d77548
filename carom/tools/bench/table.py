"""The table against the best loops written by hand and against esper, on contiguous rows and on rows with gaps."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from statistics import median

import numpy as np

from carom.ecs import (
    Collider,
    Material,
    Motion,
    Phase,
    RigidBody,
    Schedule,
    System,
    Transform,
    World,
    restore_snapshot,
    state_hash,
    take_snapshot,
)
from carom.tools.bench.measure import Figure, Timing, compared, figure, timed
from carom.tools.bench.table_loops import DT, by_esper, by_numba, by_numpy, scheduled
from carom.tools.bench.table_worlds import contiguous, fragmented, numbers, some

PEERS = ("esper",)
MILLION = 1_000_000
FRAMES = 20  # of ours to one of esper's, so that each finds in the processor's cache what it left there
READY = 400 * MILLION  # bytes, more than anything here takes
WITH_GAPS = 1.5  # how much larger a bound may be there


def figures() -> Iterator[Figure]:
    """Time everything on both layouts."""
    yield from _updates()
    yield from _esper()
    yield from _calls("contiguous", contiguous(10_000), 1.0)
    yield from _calls("gaps", fragmented(10_000), WITH_GAPS)
    yield from _coming_and_going()
    yield from _saving()


def _updates() -> Iterator[Figure]:
    apart, mixed = contiguous(MILLION), fragmented(MILLION)
    share = len(mixed.row_numbers(Transform, Motion)) / MILLION
    for name, one, other, repeats, bound, scale in (
        ("contiguous, by Numba's loop", scheduled(apart), by_numba(apart), 41, 1.15, 1.0),
        ("contiguous, by NumPy", scheduled(apart), by_numpy(apart), 9, 1.0, 1.0),
        ("gaps, by Numba's loop there", scheduled(mixed), by_numba(mixed), 41, WITH_GAPS * 1.15, 1.0),
        ("gaps, a row by contiguous Numba", scheduled(mixed), by_numba(apart), 41, WITH_GAPS * 1.15, 1.0 / share),
        ("gaps, by NumPy there", scheduled(mixed), by_numpy(mixed), 9, 1.0, 1.0),
    ):
        yield figure(f"update 1e6, {name}", "x", compared(one, other, repeats), bound, scale)


def _esper() -> Iterator[Figure]:
    count = 100_000
    for layout, world, bound in (("contiguous", contiguous(count), 60.0), ("gaps", fragmented(count), 60 / WITH_GAPS)):
        ratio = compared(by_esper(count, layout == "gaps"), partial(_repeat, scheduled(world)), 15)
        yield figure(f"update 1e5, {layout}, faster than esper", "x", ratio, bound, FRAMES, at_least=True)


def _repeat(frame: Callable[[], object]) -> None:
    for _ in range(FRAMES):
        frame()


def _calls(layout: str, world: World, slack: float) -> Iterator[Figure]:
    yield _each(f"query that hits the cache, {layout}", lambda: world.query(Transform, Motion).rows, 2.0 * slack)
    yield _each(f"world[Kind], {layout}", lambda: world[Transform], 1.0 * slack)
    systems = [System(_empty(f"empty_{k}"), (), (), ()) for k in range(12)]
    frame = partial(Schedule(Phase("only", *systems)).run, world, DT)
    yield _each(f"schedule of 12 empty systems, {layout}", frame, 15.0 * slack)


def _coming_and_going() -> Iterator[Figure]:
    position, velocity = Transform(position=numbers(MILLION, 1)), Motion(linear=numbers(MILLION, 2))
    spawned = _once(lambda: partial(World().spawn_many, MILLION, position, velocity, RigidBody()), 9)
    yield figure("spawn_many 1e6 of three components", "s", spawned, 0.3)
    grown = float(subprocess.run([sys.executable, __file__], capture_output=True, text=True, check=True).stdout)
    yield Figure("memory of these by bytes of columns", "x", grown, grown, 1.2)
    for layout, make, bound in (("contiguous", contiguous, 50.0), ("gaps", fragmented, 50.0 * WITH_GAPS)):
        yield figure(f"despawn 1e5 and query, {layout}", "ms", _once(partial(_leaving, make), 9), bound, 1e3)


def _leaving(make: Callable[[int], World]) -> Callable[[], None]:
    world = make(MILLION)
    gone = some(world.query(Transform, Motion).entities, 100_000)

    def leave() -> None:
        world.despawn(gone)
        _ = world.query(Transform, Motion).rows

    return leave


def _once(prepare: Callable[[], Callable[[], object]], repeats: int) -> Timing:
    """Time what can only be done once, each time prepared anew and with memory at hand.

    A hypervisor takes back what was free for seconds, and to get it again costs several times what is measured.
    """
    timings = []
    for _ in range(repeats):
        call = prepare()
        np.ones(READY // 8)
        timings.append(timed(call, 1))
        del call
    return Timing(median(t.wall for t in timings), median(t.cpu for t in timings), repeats)


def _saving() -> Iterator[Figure]:
    count = 10_000
    apart = World()
    apart.spawn_many(count, *_body(count))
    mixed = fragmented(count)
    for layout, world, slack in (("contiguous", apart, 1.0), ("gaps", mixed, WITH_GAPS)):
        saved = take_snapshot(world)
        for name, call, bound in (
            ("snapshot", partial(take_snapshot, world), 3.0),
            ("restore", partial(restore_snapshot, world, saved), 3.0),
            ("state hash", partial(state_hash, world), 1.0),
        ):
            yield figure(f"{name} of 1e4 bodies, {layout}", "ms", timed(call, 51), bound * slack, 1e3)


def _body(count: int) -> tuple[Transform, Motion, RigidBody, Collider, Material]:
    position, velocity = Transform(position=numbers(count, 1)), Motion(linear=numbers(count, 2))
    return position, velocity, RigidBody(), Collider(), Material()


def _empty(name: str) -> Callable[[World, float], None]:
    def nothing(world: World, dt: float) -> None:
        pass

    nothing.__name__ = name
    return nothing


def _each(name: str, call: Callable[[], object], bound: float) -> Figure:
    timing = timed(lambda: [call() for _ in range(2000)], 15)
    return figure(name, "us", timing, bound, 1e6 / 2000)


def grown() -> float:
    """Return by how much more memory this process holds for a million entities than their columns have bytes."""
    statm, page = Path("/proc/self/statm"), 4096
    before = int(statm.read_text().split()[1])
    world = contiguous(MILLION)
    held = (int(statm.read_text().split()[1]) - before) * page
    arrays = [array for kind in (Transform, Motion, RigidBody) for array in world.table(kind).arrays.values()]
    return held / sum(array.nbytes for array in arrays)


if __name__ == "__main__":
    print(grown())
