"""Booked: what the ledger of energy holds, as a curve for each entry."""

from __future__ import annotations

from collections import Counter
from typing import ClassVar

from carom.ecs import World
from carom.systems.ledger import Ledger
from carom.systems.simulation import Simulation
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track

PATH = "plots/ledger"


class Booked(Track):
    """Energies (J) that forces, contacts, impacts and corrections gave since the ledger is kept; else nothing."""

    key: ClassVar[str] = "ledger"

    def __init__(self) -> None:
        self._pending: list[tuple[Stamp, Counter[str]]] = []

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the curves where the world keeps a ledger."""
        if world[Ledger].kept:
            layout.plot(PATH, "Energy given and taken (J)")

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the entries of this frame."""
        ledger = simulation.world[Ledger]
        if ledger.kept:
            self._pending.append((stamp, Counter(ledger.since)))

    def write(self, stream: Stream) -> None:
        """Write the kept entries, one block per curve."""
        import rerun

        stamps = [stamp for stamp, _ in self._pending]
        for name in sorted({name for _, booked in self._pending for name in booked}):
            curve = [booked[name] for _, booked in self._pending]
            stream.rows(f"{PATH}/{name}", stamps, rerun.Scalars.columns(scalars=curve))
        self._pending = []
