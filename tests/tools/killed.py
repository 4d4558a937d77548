"""A recording whose writer is killed, for tests of what is left of it."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from carom.systems.simulation import Simulation

RATE = 240  # frames a second, of simulated and of real time
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

    def lost_at_most_a_second(self, newest: int) -> bool:
        """Tell whether a recording that ends with a frame lacks no more, of simulated or of real time."""
        return max(self.at) - newest <= RATE or self.killed - self.at[newest] <= 1.0


def record_until_killed(world: Callable[[], Simulation], path: Path, seconds: float) -> Killed:
    """Record a world of a test module in a process of its own, and kill that so long after its first frame."""
    names = {"module": world.__module__, "world": world.__name__, "folder": str(Path(__file__).parent)}
    code = CODE.format(**names, path=str(path), rate=RATE)
    at: dict[int, float] = {}
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        for line in process.stdout:
            at[int(line)] = time.monotonic()
            if at[int(line)] - at[1] > seconds:
                break
        process.send_signal(signal.SIGKILL)
        return Killed(at, time.monotonic())
