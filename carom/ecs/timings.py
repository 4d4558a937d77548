"""Timings: how long each system of a world takes, measured in every frame."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from carom.ecs.component import Resource

COMMANDS = "(commands)"  # what carries out the changes systems asked for, between phases
HEADINGS = ("system", "ms per frame", "share", "last ms", "calls")


class Timing(NamedTuple):
    """Seconds spent in one system, and how often it was called: in the last frame, and in all."""

    last_seconds: float
    last_calls: int
    seconds: float
    calls: int


class Timings(Resource, Mapping[str, Timing]):
    """The `Timing` of each system by name, in order of execution: ``print(world[Timings].table())``.

    Every schedule that runs in a world fills it. It is no state: neither hashes nor snapshots know of it.
    """

    def __init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        """Forget all frames so far, such as the first, in which kernels are loaded."""
        self.frames = 0
        self.spent: dict[str, int] = {}  # ns
        self.calls: dict[str, int] = {}
        self._earlier: tuple[dict[str, int], dict[str, int]] = {}, {}
        self._names: tuple[str, ...] = ()

    def begin(self, names: tuple[str, ...]) -> tuple[dict[str, int], dict[str, int]]:
        """Start a frame of the systems of these names; return the sums of nanoseconds and of calls to add to."""
        if names is not self._names:  # another schedule than before
            self._names = names
            self.spent = {name: self.spent.get(name, 0) for name in names}
            self.calls = {name: self.calls.get(name, 0) for name in names}
        self.frames += 1
        self._earlier = self.spent.copy(), self.calls.copy()
        return self.spent, self.calls

    def share_out(self, name: str, others: Iterable[str], nanoseconds: Iterable[int]) -> None:
        """Count what a system that is running has spent on the work of others for each of those."""
        spent, calls = self.spent, self.calls
        for other, taken in zip(others, nanoseconds, strict=True):
            if taken:
                spent[other] += taken
                calls[other] += 1
                spent[name] -= taken

    def __getitem__(self, name: str) -> Timing:
        """Return the timing of the system of that name."""
        spent, calls = self.spent[name], self.calls[name]
        before, calls_before = self._earlier[0][name], self._earlier[1][name]
        return Timing((spent - before) * 1e-9, calls - calls_before, spent * 1e-9, calls)

    def __iter__(self) -> Iterator[str]:
        """Return the names in order of execution."""
        return iter(self.spent)

    def __len__(self) -> int:
        """Return how many systems there are."""
        return len(self.spent)

    def table(self) -> str:
        """Return the systems as text, the slowest first: milliseconds per frame, share, last frame, calls."""
        whole = sum(timing.seconds for timing in self.values())
        last = sum(timing.last_seconds for timing in self.values())
        rows: list[tuple[str, ...]] = [HEADINGS]
        for name, timing in sorted(self.items(), key=lambda item: -item[1].seconds):
            rows.append(self._row(name, timing.seconds, whole, timing.last_seconds, str(timing.calls)))
        rows.append(self._row("all", whole, whole, last, ""))
        widths = [max(len(row[i]) for row in rows) for i in range(len(HEADINGS))]
        cells = [[row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])] for row in rows]
        lines = ["  ".join(row) for row in cells]
        lines.insert(1, "  ".join("-" * width for width in widths))
        return "\n".join(line.rstrip() for line in lines) + "\n"

    def _row(self, name: str, seconds: float, whole: float, last: float, calls: str) -> tuple[str, ...]:
        share = f"{seconds / whole:.0%}" if whole else ""
        return (name, f"{seconds / max(self.frames, 1) * 1e3:.3f}", share, f"{last * 1e3:.3f}", calls)
