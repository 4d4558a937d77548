"""What it takes to find where two recordings of a minute of 1,000 bodies part."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from carom.ecs import Motion
from carom.systems.observer import observed
from carom.tools.bench.break_rows import HEAPS
from carom.tools.bench.measure import Figure, figure, timed
from carom.tools.differing import compare
from carom.tools.recorder import Recorder
from carom.tools.side import Side
from carom.worlds.builder import load_text

THOUSAND = HEAPS.replace("[16, 4, 16], spacing: [2, 1, 2]", "[10, 10, 10], spacing: [2, 1.3, 2]")
FRAMES, PARTED = 3600, 2000  # frames of 1/60 s, and the one before which one body is pushed
LEAST = 1e-9  # m/s


def figures() -> Iterator[Figure]:
    """Yield the time from two files to the verdict, all that is simulated again for it included."""
    with TemporaryDirectory() as folder:
        paths = [Path(folder, f"{name}.rrd") for name in "ab"]
        for path in paths:
            _record(path, parted=path is paths[1])
        bound = "diff of two minutes of 1,000 bodies"
        yield figure(bound, "s", timed(lambda: compare(*(Side(str(path)) for path in paths)), 3), 5.0)


def _record(path: Path, *, parted: bool) -> None:
    loaded = load_text(THOUSAND, "heaps.yaml")
    simulation, recorder = loaded.simulation, Recorder(path, source=loaded.source_text)
    with observed(simulation, recorder):
        simulation.step(PARTED)
        if parted:
            with simulation.world.edit(Motion) as motion:
                motion.linear[simulation.world.row_numbers(Motion)[0], 0] += LEAST
        simulation.step(FRAMES - PARTED)
