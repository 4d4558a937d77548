"""Watching: a world that begins anew whenever one of its files is saved."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path

from carom.ecs.errors import CaromError
from carom.systems.simulation import Simulation
from carom.worlds.builder import LoadedWorld
from carom.worlds.errors import WorldError

INTERVAL = 0.05  # s between two looks at files: what is seen is as old as two of them at most
INTERRUPTED = 130  # what a run returns that was ended by Ctrl-C
Stamp = tuple[int, int, int] | None


class RenewedError(Exception):
    """Ends a run: its world was saved and can be loaded anew."""

    def __init__(self, loaded: LoadedWorld) -> None:
        super().__init__()
        self.loaded = loaded


class Watching:
    """Looks at the files of a world, and loads it anew when one of them was saved.

    As an observer it ends a run then, by RenewedError. A world that cannot be loaded is told of, and what runs goes on.
    Files count as saved when two looks find them the same, and other than before: none is read while it is written.
    """

    def __init__(
        self,
        path: Path,
        load: Callable[[], LoadedWorld],
        *,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._load, self._clock, self._sleep = load, clock, sleep
        self._known: dict[Path, Stamp] = {path: None}
        self._seen: dict[Path, Stamp] = {}
        self._looked = clock() - INTERVAL
        self._loaded = False

    def begin(self, simulation: Simulation) -> None:
        """Have seen everything before the run."""

    def observe(self, simulation: Simulation) -> None:
        """End the run where its world is another."""
        if self._clock() - self._looked >= INTERVAL and (loaded := self.look()):
            raise RenewedError(loaded)

    def end(self, simulation: Simulation) -> None:
        """Have nothing to finish."""

    def wait(self) -> LoadedWorld:
        """Return the world as soon as it has been saved and can be loaded."""
        while (loaded := self.look()) is None:
            self._sleep(INTERVAL)
        return loaded

    def look(self) -> LoadedWorld | None:
        """Return the world where it was saved since it was loaded last; tell on stderr why it cannot be loaded."""
        self._looked = self._clock()
        before, self._seen = self._seen, {path: stamp(path) for path in self._known}
        if self._seen == self._known or self._seen != before:
            return None
        self._known, began = self._seen, time.time_ns()
        try:
            loaded = self._load()
        except CaromError as fault:
            kept = "what was loaded before is kept" if self._loaded else "it is tried again when it is saved"
            print(f"{fault}\n{kept}", file=sys.stderr, flush=True)
            self._follow(fault.files if isinstance(fault, WorldError) else (), began)
            return None
        self._follow(loaded.files.values(), began)
        self._loaded = True
        return loaded

    def told(self) -> str:
        """Return in words what is looked at."""
        first, *others = self._known
        beside = f" and {len(others)} file{'s' if len(others) > 1 else ''} that it names" if others else ""
        return f"watching {first}{beside}; Ctrl-C ends"

    def _follow(self, paths: Iterable[Path], began: int) -> None:
        """Look at these files too; one saved since ``began`` (ns), when reading them began, counts as other."""
        for path in paths:
            found = stamp(path)
            if path not in self._known:
                self._known[path] = None if found is not None and found[0] >= began else found
        self._seen = {}


def stamp(path: Path) -> Stamp:
    """Return what tells a file from what it was: time in ns, size in bytes and inode; None where there is none."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size, found.st_ino


def keep_running(watching: Watching, run: Callable[[LoadedWorld], int]) -> int:
    """Run a world, and anew whenever it is saved, until Ctrl-C; a first run that cannot be done raises CaromError."""
    try:
        loaded, runs = watching.wait(), 0
        while True:
            try:
                if run(loaded) == INTERRUPTED:
                    return 0
                print(watching.told(), file=sys.stderr, flush=True)
                loaded = watching.wait()
            except RenewedError as renewed:
                loaded = renewed.loaded
            except CaromError as fault:  # of an option that the world as it is now does not go with
                if not runs:
                    raise
                print(fault, file=sys.stderr, flush=True)
                loaded = watching.wait()
            runs += 1
    except KeyboardInterrupt:
        return 0
