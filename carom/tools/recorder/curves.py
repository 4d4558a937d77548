"""Curves: a track that is a plot, of which each frame has a number for every curve."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import ClassVar

from carom.ecs import World
from carom.systems.simulation import Simulation
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track

ROOT = "plots"


class Curves(Track):
    """Numbers in ``unit``, a curve each below ``plots/`` and the track's key; `carom query` has them as its table."""

    unit: ClassVar[str] = "1"
    title: ClassVar[str]

    def __init__(self) -> None:
        self._pending: list[tuple[Stamp, dict[str, float]]] = []

    @abstractmethod
    def read(self, simulation: Simulation) -> Mapping[str, float]:
        """Return the numbers of this frame by the names of their curves, which may be others in every frame."""

    def path(self, name: str) -> str:
        """Return the path of a curve, always the same."""
        return f"{ROOT}/{self.key}/{name}"

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the plot."""
        layout.plot(f"{ROOT}/{self.key}", self.title)

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the numbers of this frame."""
        self._pending.append((stamp, dict(self.read(simulation))))

    def write(self, stream: Stream) -> None:
        """Write the kept numbers, one block per curve."""
        import rerun

        for name in sorted({name for _, values in self._pending for name in values}):
            held = [(stamp, values[name]) for stamp, values in self._pending if name in values]
            stamps, curve = zip(*held, strict=True)
            stream.rows(self.path(name), stamps, rerun.Scalars.columns(scalars=curve))
        self._pending = []
