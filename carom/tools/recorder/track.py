"""Track: one kind of thing a recording holds."""

from __future__ import annotations

from typing import Protocol

from carom.systems.simulation import Simulation
from carom.tools.recorder.stream import Stamp, Stream


class Track(Protocol):
    """What samples the world cheaply in recorded frames, and writes its samples in blocks about once a second."""

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep what the recording needs of this frame."""

    def write(self, stream: Stream) -> None:
        """Write what was kept since the last call."""
