"""Crew: threads that take their parts of a kernel, with no Python in between, which would take longer than most do."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from collections.abc import Callable
from typing import Any

import numpy as np

from carom.systems.kernels.crew_words import call, count_up, describe, give_way, look, tell
from carom.systems.kernels.kernel import Kernel, handed, kernel, woven
from carom.systems.kernels.lane_widths import WIDTH

# Words of the crew: which shift it is, none where odd; the kernel and its arguments; how many take part. On the next
# line of the cache the gate, where they wait for each other. Then for each thread but the first what it was asked for,
# so often, and on a line of its own which shift it has come to, how often it has done what it was asked for, and
# whether it failed the last time: who waits on a line that nobody writes disturbs nobody.
LINE = 8
SHIFT, TASK, DATA, PARTS, GATE = 0, 1, 2, 3, LINE
ASKED, HERE, DONE, FAILED, ROOM = 0, LINE, LINE + 1, LINE + 2, 2 * LINE
SPINS = 200  # looks at a word before a thread lets others have its processor


def make_crew(parts: int) -> np.ndarray[Any, np.dtype[np.int64]]:
    """Return the words of a crew of so many threads, of which the others are still to come."""
    crew = np.zeros(ROOM * parts, np.int64)
    crew[SHIFT] = 1
    return crew


def threads_of(crew: np.ndarray[Any, np.dtype[np.int64]]) -> int:
    """Return how many threads a crew has at most."""
    return len(crew) // ROOM


ALONE = make_crew(1)


def shared(*outputs: str, makes_arrays: bool = False) -> Callable[[Callable[..., Any]], Kernel]:
    """Compile a function whose work threads share: its first argument is their ``crew``.

    Each thread that has come calls the function with the crew as (words, which part is its own, how many parts). It
    returns nothing, and what it writes does not depend on how many there are.
    """
    return lambda function: handed(function, hand_out, outputs, makes_arrays=makes_arrays)


def hand_out(crew, *arguments):
    """Share the work of a kernel."""
    share(describe(work, crew, arguments))  # type: ignore[name-defined]  # noqa: F821 - `handed` hands it over


@woven
def share(described):
    """Let all threads that have come do their parts of a task that `describe` has found; return when they have."""
    crew, task, data = described
    parts, shift, most = 1, look(crew, SHIFT), len(crew) // ROOM
    while parts < most and shift % 2 == 0 and look(crew, ROOM * parts + HERE) == shift:
        parts += 1
    if parts > 1:
        tell(crew, TASK, task)
        tell(crew, DATA, data)
        tell(crew, PARTS, parts)
        tell(crew, GATE, 0)
        for part in range(1, parts):
            count_up(crew, ROOM * part + ASKED)
    failed = call(task, data, 0, parts)
    for part in range(1, parts):
        wait_for(crew, ROOM * part + DONE, look(crew, ROOM * part + ASKED))
        failed += look(crew, ROOM * part + FAILED)
    if failed > 0:
        raise MemoryError("a kernel has no memory for its arrays")  # nothing else makes one fail


@kernel("crew")
def serve(crew, part, shift):
    """Do parts of kernels until the shift is over: what the thread of a part does."""
    own, looks = ROOM * part, 0
    done = look(crew, own + ASKED)
    tell(crew, own + DONE, done)
    tell(crew, own + HERE, shift)
    while look(crew, SHIFT) == shift:
        if look(crew, own + ASKED) == done:
            looks = rest(looks)
            continue
        tell(crew, own + FAILED, call(look(crew, TASK), look(crew, DATA), part, look(crew, PARTS)))
        done += 1
        tell(crew, own + DONE, done)


@woven
def part_of(crew, count):
    """Return where the part of a thread begins and ends among ``count``."""
    _, part, parts = crew
    return count * part // parts, count * (part + 1) // parts


@woven
def part_of_run(crew, run, run_ends):
    """Return where a thread's part of a run of groups begins and ends: bodies stay in its cache."""
    first = run_ends[run - 1] if run else 0
    begin, end = part_of(crew, run_ends[run] - first)
    return first + begin, first + end


@woven
def eights_of(crew, count):
    """Return where the part of a thread begins and ends among ``count`` rows, of which eight are not parted."""
    begin, end = part_of(crew, (count + WIDTH - 1) // WIDTH)
    return WIDTH * begin, min(WIDTH * end, count)


@woven
def runs_of(crew, row_a, row_b):
    """Return where the part of a thread begins and ends among rows, of which those of one pair are not parted."""
    begin, end = part_of(crew, len(row_a))
    while 0 < begin < len(row_a) and row_a[begin] == row_a[begin - 1] and row_b[begin] == row_b[begin - 1]:
        begin += 1
    while 0 < end < len(row_a) and row_a[end] == row_a[end - 1] and row_b[end] == row_b[end - 1]:
        end += 1
    return begin, end


@woven
def wait_for_all(crew, passed):
    """Wait until all who share have come to the gate for the ``passed``-th time."""
    words, _, parts = crew
    if parts > 1:
        count_up(words, GATE)
        wait_for(words, GATE, parts * passed)


@woven
def wait_for(crew, word, value):
    """Wait until a word has come to a value."""
    looks = 0
    while look(crew, word) < value:
        looks = rest(looks)


@woven
def rest(looks):
    """Let other threads have the processor after so many looks; return how many there have been since."""
    if looks < SPINS:
        return looks + 1
    give_way()
    return 0
