"""Snapshots: the whole state in full precision and its hash, about once a second, to replay from."""

from __future__ import annotations

from carom.ecs import bytes_from_snapshot, state_hash, take_snapshot
from carom.systems.simulation import Simulation
from carom.tools.recorder.stream import Stamp, Stream

PATH = "snapshots"
EVERY = 1.0  # s, of simulated time


class Snapshots:
    """Snapshots and hashes of state, at the first recorded frame of every simulated second."""

    def __init__(self) -> None:
        self._due = 0.0
        self._pending: list[tuple[Stamp, bytes, str]] = []

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep a snapshot when one is due."""
        if stamp.time >= self._due:
            world = simulation.world
            self._pending.append((stamp, bytes_from_snapshot(take_snapshot(world)), state_hash(world)))
            self._due = stamp.time + EVERY

    def write(self, stream: Stream) -> None:
        """Write the kept snapshots."""
        import pyarrow
        import rerun

        if self._pending:
            stamps, states, hashes = zip(*self._pending, strict=True)
            columns = rerun.AnyValues.columns(state=pyarrow.array(states, pyarrow.binary()), hash=list(hashes))
            stream.rows(PATH, stamps, columns)
            self._pending = []
