"""Measure: timings, and figures with their bounds."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from math import isinf
from statistics import median
from time import perf_counter, process_time
from typing import Literal

from carom.ecs.errors import CaromError
from carom.tools.bench import BENCHES

By = Literal["wall", "cpu", "value"]


class PeerMissingError(CaromError):
    """A bench compares with a library that is not installed."""


@dataclass(frozen=True)
class Timing:
    """Medians over the repeats: seconds, or how many times longer one takes than another."""

    wall: float
    cpu: float
    repeats: int


@dataclass(frozen=True)
class Figure:
    """A measured value by wall and by CPU time, or both alike where none was timed.

    ``bound`` applies to the one named by ``by``.
    """

    name: str
    unit: str
    wall: float
    cpu: float
    bound: float
    by: By = "wall"
    at_least: bool = False
    repeats: int = 1

    @property
    def holds(self) -> bool:
        """Whether the bound holds."""
        value = self.cpu if self.by == "cpu" else self.wall
        return bool(value >= self.bound if self.at_least else value <= self.bound)  # not one of NumPy, for JSON

    def __str__(self) -> str:
        """Return one line."""
        verdict = "holds" if self.holds else "FAILS"
        values = f"wall {self.wall:10.4g}  cpu {self.cpu:10.4g} {self.unit}"
        bound = (
            "no bound"
            if isinf(self.bound)
            else f"{'at least' if self.at_least else 'at most'} {self.bound:g} {self.unit}"
        )
        if self.by == "value":
            return f"{verdict}  {self.name:<42} {f'{self.wall:.4g} {self.unit}':<42} {bound}"
        return f"{verdict}  {self.name:<42} {values:<42} {bound} by {self.by}, median of {self.repeats}"


def measure(name: str, parts: Sequence[str] = ()) -> Iterator[Figure]:
    """Yield the figures of a bench, or of some of its parts, as they come.

    Raises PeerMissingError naming the extra when a peer is missing, and CaromError for parts it does not have.
    """
    bench = import_module(f"carom.tools.bench.{BENCHES[name]}")
    missing = [peer for peer in getattr(bench, "PEERS", ()) if find_spec(peer) is None]
    if missing:
        raise PeerMissingError(f"bench {name} compares with {', '.join(missing)}; run: pip install 'carom[peers]'")
    known = getattr(bench, "PARTS", {})
    if unknown := [part for part in parts if part not in known]:
        accepted = f"its parts are {', '.join(known)}" if known else "it is measured as a whole"
        raise CaromError(f"bench {name} has no part {', '.join(unknown)}; {accepted}")
    for call in [known[part] for part in parts] or [bench.figures]:
        yield from call()


def machine() -> str:
    """Return the line that tells machines apart."""
    from carom.tools.doctor import processor, python

    return f"{processor()}; Python {python()}"


def timed(function: Callable[[], object], repeats: int) -> Timing:
    """Time calls of a function in this process."""
    walls, cpus = [], []
    for _ in range(repeats):
        wall, cpu = perf_counter(), process_time()
        function()
        walls.append(perf_counter() - wall)
        cpus.append(process_time() - cpu)
    return Timing(median(walls), median(cpus), repeats)


def compared(one: Callable[[], object], other: Callable[[], object], repeats: int, calls: int = 1) -> Timing:
    """Return how many times longer one function takes than another, called ``calls`` times for each of its calls.

    They are called in turns, so that what else the machine does meets both alike; first calls do not count.
    """
    one(), other()
    taken = [(timed(one, 1), timed(other, calls)) for _ in range(repeats)]
    return Timing(median(a.wall / b.wall for a, b in taken), median(a.cpu / b.cpu for a, b in taken), repeats)


def figure(name: str, unit: str, timing: Timing, bound: float, scale: float = 1.0, *, at_least: bool = False) -> Figure:
    """Return the figure of a timing times ``scale``, bounded by CPU time."""
    return Figure(name, unit, scale * timing.wall, scale * timing.cpu, bound, "cpu", at_least, timing.repeats)


def timed_process(command: Sequence[str], repeats: int, environment: dict[str, str] | None = None) -> Timing:
    """Time a command from its start to its end; raise CaromError with its last words when it fails."""
    walls, cpus = [], []
    for _ in range(repeats):
        wall, before = perf_counter(), os.times()
        done = subprocess.run(
            command, capture_output=True, text=True, env={**os.environ, **(environment or {})}, check=False
        )
        after = os.times()
        if done.returncode:
            raise CaromError(f"{' '.join(command)} ended with {done.returncode}: {done.stderr.strip()[-400:]}")
        walls.append(perf_counter() - wall)
        cpus.append(after.children_user + after.children_system - before.children_user - before.children_system)
    return Timing(median(walls), median(cpus), repeats)
