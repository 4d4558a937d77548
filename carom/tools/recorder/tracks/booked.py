"""Booked: what the ledger of energy holds, as a curve for each entry."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from carom.ecs import World
from carom.systems.ledger import Ledger
from carom.systems.simulation import Simulation
from carom.tools.recorder.curves import Curves
from carom.tools.recorder.layout import Layout


class Booked(Curves):
    """Energies (J) that forces, contacts, impacts and corrections gave since the ledger is kept; else nothing."""

    key: ClassVar[str] = "ledger"
    unit: ClassVar[str] = "J"
    title: ClassVar[str] = "Energy given and taken (J)"

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the curves where the world keeps a ledger."""
        if world[Ledger].kept:
            super().lay_out(world, layout)

    def read(self, simulation: Simulation) -> Mapping[str, float]:
        """Return the entries so far."""
        ledger: Ledger = simulation.world[Ledger]
        return ledger.since if ledger.kept else {}
