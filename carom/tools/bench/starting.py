"""Starting: how long a newcomer waits."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from carom.tools.bench.measure import Figure, Timing, timed_process

CAROM = [sys.executable, "-m", "carom.tools.cli"]
OUTPUTS = {"record": "rrd", "film": "mp4", "picture": "png"}


def figures() -> Iterator[Figure]:
    """Time import, help, the first compile of all kernels, and the demo once all is set up."""
    yield _figure("import carom", timed_process([sys.executable, "-c", "import carom"], 7), 0.3)
    yield _figure("carom --help", timed_process([*CAROM, "--help"], 7), 0.6)
    with tempfile.TemporaryDirectory() as folder:
        compiled = timed_process([*CAROM, "warm"], 1, {"NUMBA_CACHE_DIR": str(Path(folder) / "cache")})
        yield _figure("kernels, first compile", compiled, 15.0)
        outputs = [f"--{kind}={Path(folder) / f'billiards.{ending}'}" for kind, ending in OUTPUTS.items()]
        yield _figure("make demo, once set up", timed_process([*CAROM, "run", "billiards", *outputs], 1), 60.0)


def _figure(name: str, timing: Timing, bound: float) -> Figure:
    return Figure(name, "s", timing.wall, timing.cpu, bound, repeats=timing.repeats)
