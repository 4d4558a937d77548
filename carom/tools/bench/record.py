"""Record: what a recording costs, what of it outlives a kill, and how fast it is read and answers."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from functools import partial
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from carom.tools.asking import ask
from carom.tools.bench.killed import killed
from carom.tools.bench.measure import Figure, figure, timed
from carom.tools.bench.recorder_rows import light, memory
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.tracks.contacts import Contacts
from carom.tools.recording import Recording

FRAMES, RATE = 1000, 60
CONTACTS = 1000  # in each frame, so that there are a million
QUESTION = "contacts where depth > 0.01 and speed > 5"


def figures() -> Iterator[Figure]:
    """Measure all parts."""
    for part in PARTS.values():
        yield from part()


def answers() -> Iterator[Figure]:
    """Time reading and asking; the table is made anew by each question."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "million.rrd"
        write_contacts(path, FRAMES, CONTACTS)
        yield figure("read 1e6 contacts", "s", timed(partial(Recording, path), 5), inf)
        recording = Recording(path)
        yield figure("query of 1e6 contacts, read before", "s", timed(lambda: ask(recording, QUESTION), 9), 1.0)


def write_contacts(path: Path, frames: int, count: int) -> None:
    """Write a recording of ``count`` contacts a frame, of which the question finds a quarter."""
    import rerun.blueprint

    chance = np.random.default_rng(1)
    stream = Stream("contacts")
    stream.to_file(path, rerun.blueprint.Blueprint())
    contacts = Contacts()
    for frame in range(frames):
        rows: dict[str, Any] = {side: chance.integers(0, count, count) for side in ("a", "b")}
        rows |= {name: chance.random((count, 3)) for name in ("point", "normal")}
        rows |= {"depth": 0.02 * chance.random(count), "impulse": chance.random(count)}
        contacts.keep(Stamp(frame, frame / RATE), rows | {"speed": (10.0 * chance.random(count)).astype(np.float32)})
        if frame % RATE == 0:
            contacts.write(stream)
    contacts.write(stream)
    stream.close()


PARTS: dict[str, Callable[[], Iterator[Figure]]] = {
    "light": light,
    "memory": memory,
    "killed": killed,
    "answers": answers,
}
