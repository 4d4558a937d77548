"""Killed: recordings whose writer is killed, and what is left of them."""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from carom.systems.simulation import Simulation
from carom.tools.bench.measure import Figure
from carom.tools.recording import Recording
from carom.tools.salvage import salvage

RATE = 240  # frames a second, of simulated and of real time
MOMENTS, LONGEST = 50, 3.0  # s
CODE = """
import sys, time
sys.path.insert(0, {folder!r})
from pathlib import Path
from {module} import {world}
from carom.tools.recorder import Recorder
simulation = {world}()
recorder = Recorder(Path({path!r}))
simulation.observers.append(recorder)
recorder.begin(simulation)
while True:
    simulation.step()
    print(simulation.frame, flush=True)
    time.sleep(1 / {rate})
"""


@dataclass(frozen=True)
class Killed:
    """When (s) the writer said each frame, and when it was killed."""

    at: dict[int, float]
    killed: float

    def lost(self, newest: int) -> float:
        """Return how much a recording that ends with a frame lacks: s of simulated or of real time, the less."""
        return min((max(self.at) - newest) / RATE, self.killed - self.at.get(newest, self.at[1]))


def record_until_killed(world: Callable[[], Simulation], path: Path, seconds: float) -> Killed:
    """Record the world of a module's function in a process of its own; kill that so long after its first frame."""
    module = world.__module__
    folder = Path(str(sys.modules[module].__file__)).parents[module.count(".")]
    code = CODE.format(module=module, world=world.__name__, folder=str(folder), path=str(path), rate=RATE)
    at: dict[int, float] = {}
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        for line in process.stdout:
            at[int(line)] = time.monotonic()
            if at[int(line)] - at[1] > seconds:
                break
        process.send_signal(signal.SIGKILL)
        return Killed(at, time.monotonic())


def lone_ball() -> Simulation:
    """Return a ball that bounces on the ground."""
    simulation = Simulation(dt=1 / RATE)
    bouncy = {"restitution": 1.0}
    simulation.add(collider={"plane": {}}, material=bouncy)
    place = {"position": (0.0, 2.0, 0.0)}
    simulation.add(name="ball", collider={"sphere": {"radius": 0.5}}, body={}, material=bouncy, transform=place)
    return simulation


def killed() -> Iterator[Figure]:
    """Kill a recorded run at random moments, salvage each file and read it."""
    chance, lost = random.Random(1), []
    for _ in range(MOMENTS):
        with tempfile.TemporaryDirectory() as folder:
            path, mended = Path(folder) / "killed.rrd", Path(folder) / "mended.rrd"
            ended = record_until_killed(lone_ball, path, chance.uniform(0.0, LONGEST))
            salvage(path, mended)
            lost.append(ended.lost(Recording(mended).frames[-1]))
    yield Figure(f"most lost by kill -9 at {MOMENTS} moments", "s", max(lost), max(lost), 1.0, "value")
