"""Hand thousands of mutants in: python tests/fuzz/fuzz.py --cases 20000, or one of them again: --case 1234."""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from multiprocessing.connection import Connection, wait
from pathlib import Path

from trial import trial

from carom.worlds import load_world

SECONDS = 60  # of the processor that a case may take: three times what any has taken here
PATIENCE = 300.0  # s that a case may take by the clock: waiting for what never comes takes no processor
MEMORY = 3 << 30  # bytes that a case may take


def attempt(case: int, folder: Path) -> tuple[str, str]:
    """Return how a case ended: a word, and the trace of what carom must not do, if it did."""
    try:
        return trial(case, folder), ""
    except Exception:
        return "FOUND", traceback.format_exc()


def work(connection: Connection) -> None:
    """Take cases until there are no more, within the limits; what goes beyond them ends this process."""
    load_world("bounce").simulation.step()  # with what any case needs in memory
    with tempfile.TemporaryDirectory() as folder:
        size = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (size + MEMORY, size + MEMORY))
        while (case := connection.recv()) is not None:
            taken = resource.getrusage(resource.RUSAGE_SELF)
            most = int(taken.ru_utime + taken.ru_stime) + SECONDS
            resource.setrlimit(resource.RLIMIT_CPU, (most, resource.RLIM_INFINITY))
            connection.send((case, *attempt(case, Path(folder))))


class Worker:
    """A process that takes cases; a new one takes its place where a case ends it."""

    def __init__(self) -> None:
        self.start()

    def start(self) -> None:
        """Start the process."""
        self.case, self.since = -1, time.monotonic()
        self.connection, other = multiprocessing.Pipe()
        self.process = multiprocessing.get_context("spawn").Process(target=work, args=(other,), daemon=True)
        self.process.start()
        other.close()

    def give(self, case: int | None) -> None:
        """Give it a case, or the word that there are no more."""
        self.case, self.since = -1 if case is None else case, time.monotonic()
        self.connection.send(case)

    def take(self) -> tuple[int, str, str]:
        """Return how its case ended; start anew where the process did not outlive it."""
        try:
            if self.connection.poll():
                return self.connection.recv()  # type: ignore[no-any-return]
        except EOFError:
            pass
        self.process.kill()
        self.process.join()
        case, status = self.case, self.process.exitcode
        self.start()
        return (
            case,
            "FOUND",
            f"the process ended ({status}), after {SECONDS} s of the processor or {PATIENCE} s at most",
        )


def fuzz(cases: list[int], count: int) -> Iterator[tuple[int, str, str]]:
    """Yield how each case ended, in the order of their ends, on so many processes."""
    workers = [Worker() for _ in range(count)]
    left = iter(cases)
    busy: dict[Connection, Worker] = {}
    for worker in workers:
        if (case := next(left, None)) is not None:
            worker.give(case)
            busy[worker.connection] = worker
    while busy:
        ready = wait(list(busy), timeout=1.0)
        late = [key for key, worker in busy.items() if time.monotonic() - worker.since > PATIENCE]
        for key in {*ready, *late}:
            worker = busy.pop(key)  # type: ignore[arg-type]
            yield worker.take()
            if (case := next(left, None)) is not None:
                worker.give(case)
                busy[worker.connection] = worker
    for worker in workers:
        worker.give(None)
        worker.process.join()


def main() -> int:
    """Return 0 where carom did with all cases what it must."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=20_000, help="how many")
    parser.add_argument("--first", type=int, default=0, help="the number of the first")
    parser.add_argument("--case", type=int, help="one alone, in this process, with its files left in ./fuzzed")
    parser.add_argument("--workers", type=int, default=2)
    arguments = parser.parse_args()
    if arguments.case is not None:
        folder = Path("fuzzed")
        folder.mkdir(exist_ok=True)
        print(trial(arguments.case, folder))
        return 0
    began, ends = time.monotonic(), Counter[str]()
    cases = list(range(arguments.first, arguments.first + arguments.cases))
    for case, end, told in fuzz(cases, arguments.workers):
        ends[end] += 1
        if told:
            print(f"case {case}: {told}", flush=True)
    counts = ", ".join(f"{number} {end}" for end, number in sorted(ends.items()))
    print(f"{sum(ends.values())} cases in {time.monotonic() - began:.0f} s: {counts}")
    return 1 if ends["FOUND"] else 0


if __name__ == "__main__":
    sys.exit(main())
