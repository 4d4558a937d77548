"""Last frames: what every simulation of a test just did, kept to be recorded should a check not pass."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from weakref import WeakKeyDictionary

import pytest

from carom.ecs import System, restore_snapshot, take_snapshot
from carom.systems.ring import Ring
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera

COUNT = 30  # half a second at 60 Hz


class LastFrames:
    """The last frames of simulations, as snapshots: exact whatever a test does to a world between two steps."""

    def __init__(self) -> None:
        self._rings: WeakKeyDictionary[Simulation, Ring] = WeakKeyDictionary()

    @contextmanager
    def kept(self) -> Iterator[LastFrames]:
        """Keep them of every simulation that steps."""
        take = Simulation.step

        def step(simulation: Simulation, count: int = 1, *, after: Callable[[System], None] | None = None) -> None:
            ring = self._rings.setdefault(simulation, Ring(COUNT))
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

        world = simulation.world
        now = take_snapshot(world)
        ring = self._rings.get(simulation)
        earlier = [snapshot for snapshot in ring.snapshots if snapshot.frame < now.frame] if ring is not None else []
        recorder = Recorder(path, every=1, title=title, camera=camera)
        show = recorder.begin
        for snapshot in (*earlier, now):
            restore_snapshot(world, snapshot)
            show(simulation)
            show = recorder.observe
        recorder.end(simulation)
