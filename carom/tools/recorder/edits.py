"""Edits: what code outside the step did between two of them, as the input log of a recording."""

from __future__ import annotations

from carom.ecs.component import Record
from carom.systems.awake import Awake
from carom.systems.simulation import Simulation
from carom.tools.recorder.stream import Stamp, Stream

PATH = "edits"
LIVES, RESTORED = "who lives", "a snapshot restored"


class Edits:
    """The components that were written before a step, who came or went, snapshots restored; recorded frame or not."""

    def __init__(self) -> None:
        self._own: set[type[Record]] = set()
        self._counts = (0, 0)
        self._pending: list[tuple[Stamp, str]] = []

    def begin(self, simulation: Simulation) -> None:
        """Know what was done before the recording, or by commands of the last step."""
        world = simulation.world
        self._own, self._counts = set(world.edited), (world.structure, world.restored)

    def sample(self, simulation: Simulation, stamp: Stamp) -> bool:
        """Keep what was done between the step that has just been taken and the one before; tell whether anything."""
        awake = simulation.world[Awake]
        done = sorted(kind.__name__ for kind in awake.edited - self._own)
        if awake.restored != self._counts[1]:
            done.append(RESTORED)
        elif awake.structure != self._counts[0]:
            done.append(LIVES)
        self.begin(simulation)
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
