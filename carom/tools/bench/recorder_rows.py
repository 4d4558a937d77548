"""Recorder rows: what a recording in `light` adds to a step, to the disk and to memory."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from carom.ecs import Motion
from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.bench.killed import lone_ball
from carom.tools.bench.measure import Figure, Timing, figure, timed
from carom.tools.reading import read
from carom.tools.recorder import Recorder
from carom.tools.recorder.stream import FRAME
from carom.tools.recorder.tracks.bodies import ROOT

COUNTS = (1000, 10_000)
SECONDS, RATE = 9, 60
EACH, ALWAYS = 0.1e-3, 0.3  # ms a body and frame, ms a frame
AT_ONCE = 20  # chunks, about as many as there are in a second
FRAMES, WARM = 100_000, 20_000
FLAT = 16.0  # MiB: Rerun keeps where each chunk is, 6 kB of it, until the end, and blocks grow so that these are few


def rolling(count: int) -> Simulation:
    """Return balls that roll about on the ground, and now and then into each other."""
    simulation, chance = Simulation(checked=False, sleeping=False), np.random.default_rng(1)
    simulation.add(collider={"plane": {}})
    side = int(np.ceil(np.sqrt(count)))
    k = np.arange(count)
    places = np.column_stack([1.25 * (k % side), np.full(count, 0.5), 1.25 * (k // side)])
    simulation.add_many(places, collider={"sphere": {"radius": 0.5}}, body={})
    with simulation.world.edit(Motion) as motion:
        rows = simulation.world.row_numbers(Motion)
        motion.linear[rows] = chance.uniform(-1.0, 1.0, (count, 3)) * [1.0, 0.0, 1.0]
    return simulation


def light() -> Iterator[Figure]:
    """Step and observe in turns; the CPU time is that of all threads, and of a second's frames with what ends it.

    Beside it stands what Rerun alone takes to write the same chunks, as they were read back.
    """
    for count in COUNTS:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "light.rrd"
            simulation, recorder = rolling(count), Recorder(path)
            recorder.begin(simulation)
            taken = [a_second(simulation, recorder) for _ in range(SECONDS)]
            recorder.end(simulation)
            wall, cpu = (float(np.median([getattr(one, clock) for one in taken])) for clock in ("wall", "cpu"))
            bound = ALWAYS + EACH * count
            yield figure(f"light, {count} bodies that touch", "ms", Timing(wall, cpu, SECONDS), bound, 1e3 / RATE)
            alone = rerun_alone(path, Path(folder) / "alone.rrd")
            yield figure(f"of it Rerun's, {count} bodies", "ms", alone, inf, 1e3 / (1 + SECONDS * RATE))
            yield from _bytes(path, count)


def a_second(simulation: Simulation, recorder: Recorder) -> Timing:
    """Return what recording a second takes."""
    taken = []
    for _ in range(RATE):
        simulation.step()
        taken.append(timed(partial(recorder.observe, simulation), 1))
    return Timing(sum(one.wall for one in taken), sum(one.cpu for one in taken), 1)


def rerun_alone(path: Path, out: Path) -> Timing:
    """Return what it takes to send the chunks of a recording, made before, to a file."""
    with _rerun(out) as send:
        return timed(partial(send, _chunks(path)), 1)


def kept_by_rerun(path: Path, out: Path) -> float:
    """Return the memory (MiB) that grows while Rerun alone writes the chunks from frame WARM on, as a list of them."""
    chunks = _chunks(path)
    firsts = [batch.column(FRAME)[0].as_py() if FRAME in batch.schema.names else 0 for batch in map(_batch, chunks)]
    with _rerun(out) as send:
        send([chunk for chunk, first in zip(chunks, firsts, strict=True) if first < WARM])
        before = resident()
        send([chunk for chunk, first in zip(chunks, firsts, strict=True) if first >= WARM])
        return resident() - before


def _chunks(path: Path) -> list[Any]:
    from rerun.chunk import RrdReader

    return list(RrdReader(path).stream().to_chunks())


def _batch(chunk: Any) -> Any:
    return chunk.to_record_batch()


@contextmanager
def _rerun(out: Path) -> Iterator[Callable[[Sequence[Any]], None]]:
    """Lend what sends chunks to a file, as many at once as a recorder does."""
    import rerun

    recording = rerun.RecordingStream("alone")
    recording.save(out)

    def send(chunks: Sequence[Any]) -> None:
        for first in range(0, len(chunks), AT_ONCE):
            recording.send_chunks(chunks[first : first + AT_ONCE])
            recording.flush()

    yield send
    recording.disconnect()


def _bytes(path: Path, count: int) -> Iterator[Figure]:
    series = [rows for (at, name), rows in read(path).series.items() if at.startswith(f"/{ROOT}/") and "Pose" in name]
    values = [value for rows in series for value in rows.values]
    size = 2.0 * sum(value.nbytes for value in values) / sum(len(value) for value in values)  # place and turn
    yield Figure(f"a pose of {count} bodies, uncompressed", "B", size, size, 28.0, "value")
    on_disk = path.stat().st_size / (count * (1 + SECONDS * RATE))
    yield Figure(f"all on disk, a frame and one of {count} bodies", "B", on_disk, on_disk, inf, "value")


def memory() -> Iterator[Figure]:
    """Record a small world for long; what is held then and was not when all was warm."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "long.rrd"
        simulation, recorder = lone_ball(), Recorder(path, every=1)
        with observed(simulation, recorder):
            simulation.step(WARM)
            before = resident()
            simulation.step(FRAMES - WARM)
            grown = resident() - before
        yield Figure(f"memory grown in {FRAMES} frames, warm", "MiB", grown, grown, FLAT, "value")
        kept = kept_by_rerun(path, Path(folder) / "alone.rrd")
        yield Figure("of it Rerun's, where each chunk is", "MiB", kept, kept, inf, "value")


def resident() -> float:
    """Return the memory (MiB) of this process, as Linux counts it."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20
