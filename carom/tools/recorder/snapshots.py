"""Snapshots: the whole state in full precision and its hash, about once a second, to replay from."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from carom.ecs import bytes_from_snapshot, state_hash
from carom.ecs.snapshot import look_at
from carom.systems.simulation import Simulation
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track

PATH = "snapshots"
EVERY = 1.0  # s, of simulated time
EDITED = 0.5  # s, of simulated time between snapshots after edits: a game may edit in every step


class Snapshots(Track):
    """Snapshots and hashes of state: in the first recorded frame of every second, after edits and at the end."""

    def __init__(self) -> None:
        self._due = self._due_after_edit = 0.0
        self._kept = -1
        self._pending: list[tuple[Stamp, bytes, str]] = []

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep a snapshot when one is due."""
        if stamp.time >= self._due:
            self.keep(simulation, stamp)
            self._due = stamp.time + EVERY

    def after_edit(self, simulation: Simulation, stamp: Stamp) -> None:
        """Keep a snapshot of a step before which code outside had a hand in it, so that a replay parts in it alone."""
        if stamp.time >= self._due_after_edit:
            self.keep(simulation, stamp)
            self._due_after_edit = stamp.time + EDITED

    def keep(self, simulation: Simulation, stamp: Stamp) -> None:
        """Keep a snapshot, unless there is one of this frame."""
        if stamp.frame != self._kept:
            world = simulation.world
            self._pending.append((stamp, bytes_from_snapshot(look_at(world)), state_hash(world)))
            self._kept = stamp.frame
            self.kept += len(self._pending[-1][1])

    def write(self, stream: Stream) -> None:
        """Write the kept snapshots."""
        import rerun

        if self._pending:
            stamps, states, hashes = zip(*self._pending, strict=True)
            columns = rerun.AnyValues.columns(state=_array(states), hash=list(hashes))
            stream.rows(PATH, stamps, columns)
            self._pending, self.kept = [], 0


def _array(states: Sequence[bytes]) -> Any:
    """Return states as Arrow has them: one by itself, as large ones are written, in its own memory."""
    import pyarrow

    if len(states) > 1:
        return pyarrow.array(states, pyarrow.binary())
    ends = pyarrow.py_buffer(np.array([0, len(states[0])], np.int32))
    return pyarrow.Array.from_buffers(pyarrow.binary(), 1, [None, ends, pyarrow.py_buffer(states[0])])
