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
COLORS = {
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
        self._pending: list[tuple[Stamp, dict[str, float]]] = []

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
        world = simulation.world
        values = {f"{path}/{name}": value for path in PATHS for name, value in PATHS[path].read(world).items()}
        self._pending.append((stamp, values))

    def write(self, stream: Stream) -> None:
        """Write the kept numbers, one block per curve."""
        import rerun

        if not self._pending:
            return
        stamps = [stamp for stamp, _ in self._pending]
        for path in COLORS:
            stream.rows(path, stamps, rerun.Scalars.columns(scalars=[values[path] for _, values in self._pending]))
        self._pending = []
