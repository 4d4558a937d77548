"""Threads that share kernels: each does its part once, waits where all wait, and goes when nobody needs it any more."""

from __future__ import annotations

import gc
import threading
import time

import numba
import numpy as np
import pytest
from crews import gathered, parts_taken

from carom.systems.kernels.crew import ALONE, ROOM, SHIFT, eights_of, make_crew, part_of, runs_of, shared, wait_for_all
from carom.systems.kernels.kernel import kernel
from carom.systems.simulation import Simulation
from carom.systems.threads import Threads, crew_for

pytestmark = pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="kernels are not shared without the JIT")


@shared("counts", "seen")
def count_twice(crew, counts, seen):  # type: ignore[no-untyped-def]
    """Count up each thread's part, wait for all, then write what is seen of the others' parts."""
    begin, end = part_of(crew, len(counts))
    for k in range(begin, end):
        counts[k] += 1
    wait_for_all(crew, 1)
    for k in range(begin, end):
        seen[k] = counts[len(counts) - 1 - k]


@kernel("found")
def find_parts(words, part, parts, rows, found):  # type: ignore[no-untyped-def]
    """Write where a part begins and ends, a row each way."""
    crew = (words, part, parts)
    found[0, 0], found[0, 1] = part_of(crew, len(rows))
    found[1, 0], found[1, 1] = eights_of(crew, len(rows))
    found[2, 0], found[2, 1] = runs_of(crew, rows, rows)


@pytest.mark.parametrize("parts", [1, 2, 3, 5])
def test_each_part_is_done_once_and_all_wait_at_the_gate(parts: int) -> None:
    """Every number is counted once in each of 50 runs, and behind the gate each thread sees what all have done."""
    counts, seen = np.zeros(1001, np.int64), np.zeros(1001, np.int64)
    with gathered(parts) as crew:
        for run in range(1, 51):
            count_twice(crew, counts, seen)
            assert (counts == run).all()
            assert (seen == run).all()
        assert parts_taken(crew) == [50] * (parts - 1)


def test_who_has_not_come_is_not_waited_for() -> None:
    """Nobody serves this crew: the first thread does all."""
    counts, seen, crew = np.zeros(9, np.int64), np.zeros(9, np.int64), make_crew(4)
    crew[SHIFT] += 1
    count_twice(crew, counts, seen)
    assert (counts == 1).all()


@pytest.mark.parametrize("count", [0, 1, 7, 8, 9, 100, 1000])
@pytest.mark.parametrize("parts", [1, 2, 3, 7])
def test_parts_follow_each_other_without_gaps(parts: int, count: int) -> None:
    """Parts, eights and runs of one pair cover all, each once; eights and runs are not parted."""
    found, rows = np.empty((parts, 3, 2), np.int64), np.arange(count) // 3
    for part in range(parts):
        find_parts(ALONE, part, parts, rows, found[part])
    begins, ends = found[:, :, 0], found[:, :, 1]
    assert (begins[0] == 0).all()
    assert (begins[1:] == ends[:-1]).all()
    assert (ends[-1] == count).all()
    assert (begins <= ends).all()
    assert ((ends[:, 1] % 8 == 0) | (ends[:, 1] == count)).all()
    assert ((ends[:, 2] % 3 == 0) | (ends[:, 2] == count)).all()


def carom_threads() -> int:
    """Return how many threads of crews there are."""
    return sum(thread.name.startswith("carom ") for thread in threading.enumerate())


def test_threads_go_with_their_world(monkeypatch: pytest.MonkeyPatch) -> None:
    """A world that is dropped leaves no threads behind, nor does one that comes to ask for more or fewer."""
    monkeypatch.setattr("carom.systems.threads.processors", lambda: 8)
    before, simulation = carom_threads(), Simulation(threads=3)
    threads = simulation.world[Threads]
    with threads:
        crew = crew_for(simulation.world, 10_000)
        assert len(crew) == 3 * ROOM
        assert crew_for(simulation.world, 1) is ALONE
    assert crew_for(simulation.world, 10_000) is ALONE
    with threads:
        threads.call(2)
    assert carom_threads() <= before + 3
    del simulation, threads
    gc.collect()
    until = time.monotonic() + 60.0
    while carom_threads() > before:
        assert time.monotonic() < until
        time.sleep(1e-3)


@shared("sizes", makes_arrays=True)
def make_arrays(crew, sizes):  # type: ignore[no-untyped-def]
    """Make an array of a size that is given to each thread."""
    sizes[crew[1]] = len(np.empty(sizes[crew[1]]))


@pytest.mark.parametrize("failing", [0, 1, 2])
def test_who_finds_no_memory_says_so(failing: int) -> None:
    """Whoever of three threads fails, the caller is told; the next time all is well."""
    with gathered(3) as crew:
        sizes = np.full(3, 5)
        sizes[failing] = 1 << 58
        with pytest.raises(MemoryError, match=r"^a kernel has no memory for its arrays$"):
            make_arrays(crew, sizes)
        make_arrays(crew, np.full(3, 5))


def test_who_had_nothing_to_do_is_not_called_again() -> None:
    """They are called at once as long as the step before had work for them."""
    threads = Threads()
    called = []
    for wanted in (True, False, False):
        with threads:
            called.append(threads.crew[SHIFT] % 2 == 0 and threads.crew is not ALONE)
            if wanted:
                threads.call(2)
    assert called == [False, True, False]


def test_a_step_that_fails_sends_them_away() -> None:
    """Whatever ends a step, nobody is left waiting for work."""
    threads = Threads()
    with pytest.raises(RuntimeError, match="fails"), threads:
        crew = threads.call(2)
        assert crew[SHIFT] % 2 == 0
        raise RuntimeError("fails")
    assert crew[SHIFT] % 2 == 1
