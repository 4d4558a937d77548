"""Runs that are recorded, and replayed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from carom.ecs import state_hash
from carom.systems.observer import observed
from carom.tools.recorder import Recorder
from carom.tools.replay import Replay
from carom.tools.retrace import Verdict, retrace
from carom.worlds import LoadedWorld

BALLS = """
carom: 1
name: two balls
step: {dt: 1/120}
run: {duration: 2.5 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - {name: left, collider: {sphere: {radius: 0.2}}, body: {}, transform: {position: [-1, 1, 0]}}
  - {name: right, collider: {sphere: {radius: 0.2}}, body: {}, transform: {position: [1, 0.2, 0]}}
"""


def record(loaded: LoadedWorld, path: Path, frames: int, edits: dict[int, Any] | None = None) -> list[str]:
    """Record so many steps, doing ``edits`` after some; return the hash of every frame."""
    simulation = loaded.simulation
    title, source, files = loaded.name, loaded.source_text, loaded.contents()
    with observed(simulation, Recorder(path, title=title, source=source, files=files)):
        hashes = [state_hash(simulation.world)]
        for _ in range(frames):
            if edits and simulation.frame in edits:
                edits[simulation.frame](simulation)
            simulation.step()
            hashes.append(state_hash(simulation.world))
    return hashes


def replayed(path: Path) -> Verdict:
    """Replay the whole of a recording."""
    replay = Replay(path)
    return retrace(replay, replay.loaded(), replay.last)
