"""Crews that have come, and what the threads of a crew have done."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

from carom.ecs.column import Integers
from carom.systems.kernels.crew import DONE, HERE, ROOM, SHIFT
from carom.systems.threads import Threads


@contextmanager
def gathered(parts: int) -> Iterator[Integers]:
    """Yield a crew all of whose threads have come."""
    threads = Threads()
    with threads:
        crew = threads.call(parts)
        until = time.monotonic() + 60.0
        while (crew[ROOM + HERE :: ROOM] != crew[SHIFT]).any():
            assert time.monotonic() < until
            time.sleep(1e-4)
        yield crew


def parts_taken(crew: Integers) -> list[int]:
    """Return how many parts of kernels each thread but the first has done."""
    taken: list[int] = crew[ROOM + DONE :: ROOM].tolist()
    return taken
