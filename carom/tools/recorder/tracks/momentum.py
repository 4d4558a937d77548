"""Momentum: that of all dynamic bodies together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from carom.systems.simulation import Simulation
from carom.tools.quantities import momenta
from carom.tools.recorder.curves import Curves


class Momentum(Curves):
    """Its three components."""

    key: ClassVar[str] = "momentum"
    detail: ClassVar[str] = "full"
    title: ClassVar[str] = "Momentum (kg m/s)"
    unit: ClassVar[str] = "kg m/s"

    def read(self, simulation: Simulation) -> Mapping[str, float]:
        """Return what it is along each axis."""
        return momenta(simulation.world)
