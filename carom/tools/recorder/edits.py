"""Edits: what code outside the step did between two of them, as the input log of a recording."""

from __future__ import annotations

from carom.systems.edits import EditWatch
from carom.systems.simulation import Simulation
from carom.tools.recorder.stream import Stamp, Stream

PATH = "edits"


class Edits:
    """The components that were written before a step, who came or went, snapshots restored; recorded frame or not."""

    def __init__(self) -> None:
        self._watch = EditWatch()
        self._pending: list[tuple[Stamp, str]] = []

    def begin(self, simulation: Simulation) -> None:
        """Know what was done before the recording, or by commands of the last step."""
        self._watch.begin(simulation)

    def sample(self, simulation: Simulation, stamp: Stamp) -> bool:
        """Keep what was done between the step that has just been taken and the one before; tell whether anything."""
        done = self._watch.done(simulation)
        if done:
            self._pending.append((stamp, ", ".join(done)))
        return bool(done)

    def write(self, stream: Stream) -> None:
        """Write the kept rows."""
        import rerun

        if self._pending:
            stamps, done = zip(*self._pending, strict=True)
            stream.rows(PATH, stamps, rerun.AnyValues.columns(done=list(done)))
            self._pending = []
