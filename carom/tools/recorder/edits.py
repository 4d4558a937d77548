"""Edits: what code outside the step did between two of them, and the values it wrote, as the input log of a recording.

Each component that was opened has rows below a path of its own, also where nothing in it changed: to open it wakes.
"""

from __future__ import annotations

from collections import defaultdict

from carom.ecs.component import Component
from carom.ecs.writes import WriteLog
from carom.systems.edits import EditWatch
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Columns, joined
from carom.tools.recorder.stream import Stamp, Stream

PATH = "edits"
ENTITY = "of.entity"  # no column of a component is called so


class Edits:
    """The components that were written before a step, who came or went, snapshots restored; recorded frame or not."""

    def __init__(self) -> None:
        self._watch = EditWatch()
        self._pending: list[tuple[Stamp, str]] = []
        self._written: defaultdict[type[Component], list[tuple[Stamp, Columns]]] = defaultdict(list)

    def begin(self, simulation: Simulation) -> None:
        """Know what was done before the recording, or by commands of the last step; have values kept from now on."""
        self._watch.begin(simulation)
        simulation.world.writes = simulation.world.writes or WriteLog()

    def sample(self, simulation: Simulation, stamp: Stamp) -> bool:
        """Keep what was done between the step that has just been taken and the one before; tell whether anything."""
        words, written = self._watch.done(simulation)
        if words:
            self._pending.append((stamp, ", ".join(words)))
            for kind, (entities, values) in written.items():
                self._written[kind].append((stamp, {ENTITY: entities, **values}))
        return bool(words)

    def write(self, stream: Stream) -> None:
        """Write the kept rows."""
        import rerun

        if self._pending:
            stamps, done = zip(*self._pending, strict=True)
            stream.rows(PATH, stamps, rerun.AnyValues.columns(done=list(done)))
            for kind, pending in self._written.items():
                block = joined(pending)
                stream.rows(f"{PATH}/{kind.key}", block.stamps, block.values(block.columns))
            self._pending = []
            self._written.clear()
