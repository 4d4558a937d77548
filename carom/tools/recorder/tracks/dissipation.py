"""Dissipation: what each pair of colliders gave or took of the energy, in every step."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from carom.ecs.column import Column
from carom.ecs.relations.contact import Contact
from carom.systems.ledger import Ledger
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Columns
from carom.tools.recorder.rows import RowTrack, number


class PairWork(RowTrack):
    """The work of pairs as the ledger of energy books it, where one is kept; all rows together are its entries."""

    key: ClassVar[str] = "dissipation"
    every_step: ClassVar[bool] = True
    sparse: ClassVar[bool] = True
    path: ClassVar[str] = "dissipation"
    columns: ClassVar[Mapping[str, Column]] = {
        "a": Contact.columns["a"],
        "b": Contact.columns["b"],
        "contacts": number("J", "work of the resting contacts along their normals; below 0: lost"),
        "friction": number("J", "work of their friction; below 0: lost"),
        "impacts": number("J", "work of impacts, friction included; below 0: lost"),
    }

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return the pairs that did any work in the last step."""
        ledger = simulation.world[Ledger]
        if not ledger.kept:
            return None
        pairs = ledger.dissipation
        worked = (pairs.contacts != 0.0) | (pairs.friction != 0.0) | (pairs.impacts != 0.0)
        return {name: getattr(pairs, name)[worked] for name in self.columns} if worked.any() else None
