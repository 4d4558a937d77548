"""Plots: the numbers of a whole world over time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from carom.ecs import World
from carom.systems.simulation import Simulation
from carom.tools.quantities import QUANTITIES
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track

ENERGY, OVERLAP, COUNTS = "plots/energy", "plots/overlap", "plots/counts"
PATHS = {ENERGY: QUANTITIES["energy"], OVERLAP: QUANTITIES["overlap"], COUNTS: QUANTITIES["counts"]}
COLORS = {  # of all curves, in the order in which their numbers are read
    f"{ENERGY}/kinetic": (255, 170, 60),
    f"{ENERGY}/potential": (90, 160, 255),
    f"{ENERGY}/total": (240, 240, 240),
    f"{OVERLAP}/deepest_mm": (255, 90, 60),
    f"{COUNTS}/bodies": (120, 210, 130),
    f"{COUNTS}/contacts": (255, 90, 60),
}


class Plots(Track):
    """Energies in J, the deepest overlap in mm, and how many bodies and contacts there are."""

    key: ClassVar[str] = "plots"

    def __init__(self) -> None:
        self._pending: list[tuple[Stamp, tuple[float, ...]]] = []

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write the colours of the curves."""
        import rerun

        for path, color in COLORS.items():
            stream.static(path, rerun.SeriesLines(colors=[color], widths=[2.0]))

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show all."""
        layout.plot(ENERGY, "Energy (J)")
        layout.plot(OVERLAP, "Deepest overlap (mm)")
        layout.plot(COUNTS, "Counts")

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the numbers of this frame."""
        read = [quantity.read(simulation.world) for quantity in PATHS.values()]
        self._pending.append((stamp, tuple(value for values in read for value in values.values())))

    def write(self, stream: Stream) -> None:
        """Write the kept numbers, one block per curve."""
        import rerun

        if not self._pending:
            return
        stamps, values = zip(*self._pending, strict=True)
        for path, curve in zip(COLORS, zip(*values, strict=True), strict=True):
            stream.rows(path, stamps, rerun.Scalars.columns(scalars=curve))
        self._pending = []
