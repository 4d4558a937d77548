"""Last frames: what every simulation of a test just did, kept to be recorded should a check not pass."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from weakref import WeakKeyDictionary

import pytest

from carom.ecs import System
from carom.systems.ring import Ring
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera


class LastFrames:
    """The last second of simulations, and up to another: exact whatever a test does to a world between two steps."""

    def __init__(self) -> None:
        self._rings: WeakKeyDictionary[Simulation, Ring] = WeakKeyDictionary()

    @contextmanager
    def kept(self) -> Iterator[LastFrames]:
        """Keep them of every simulation that steps."""
        take = Simulation.step

        def step(simulation: Simulation, count: int = 1, *, after: Callable[[System], None] | None = None) -> None:
            ring = self._ring(simulation)
            if not ring.snapshots:
                ring.begin(simulation)
            simulation.observers.append(ring)
            try:
                take(simulation, count, after=after)
            finally:
                simulation.observers.remove(ring)

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(Simulation, "step", step)
            yield self

    def record(self, simulation: Simulation, path: Path, title: str, camera: Camera | None) -> None:
        """Write them, up to what the world is now, as a recording (.rrd)."""
        from carom.tools.recorder import Recorder

        self._ring(simulation).show(simulation, Recorder(path, every=1, title=title, camera=camera))

    def _ring(self, simulation: Simulation) -> Ring:
        return self._rings.setdefault(simulation, Ring.of_seconds(1.0, simulation))
