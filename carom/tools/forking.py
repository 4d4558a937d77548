"""Forking: what would have been, from a frame of a recording on, beside what was."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from carom.ecs import restore_snapshot, take_snapshot
from carom.ecs.errors import CaromError
from carom.systems.observer import Observer
from carom.systems.simulation import Simulation
from carom.tools.filming import shot_of
from carom.tools.futures import Futures
from carom.tools.recorder.of_world import recorder_of
from carom.tools.replay import Replay
from carom.tools.retrace import Verdict, retrace
from carom.worlds.assignment import assign
from carom.worlds.run import frames_of

RECORDED = "the recording"
LATER = 1.0  # s after the frame that are simulated at the least


@dataclass
class Forks:
    """The futures of a frame of a recording; the first is the recording's own, which the verdict is of."""

    futures: Futures
    verdict: Verdict
    out: Path | None
    notes: list[str] = field(default_factory=list)

    def text(self) -> str:
        """Return in words where they part, and what becomes of them."""
        verdict = self.verdict
        same = "the unchanged one is the recording, bit for bit"
        if not verdict.same:
            same = f"the unchanged one leaves the recording: {verdict.partings[0].text(verdict.dt)}"
        lines = [f"{verdict.path}: futures from frame {verdict.first} to {verdict.last}; {same}"]
        for future in self.futures.futures[1:]:
            parts = f"parts in {future.parting}" if future.parting else "does not part"
            lines.append(f"  {future.name}: {parts}")
        lines += [f"  note: {note}" for note in (*self.notes, *verdict.changes, *verdict.notes)]
        lines.append(self.futures.text())
        if self.out:
            frames = [future.parting.frame for future in self.futures.futures if future.parting]
            lines.append(f"open it with: carom view {self.out} --frame {min(frames, default=verdict.first)}")
        return "\n".join(lines)

    def values(self) -> dict[str, Any]:
        """Return it for programs."""
        told = [
            asdict(outcome) | {"parting": future.parting._asdict() if future.parting else None}
            for future, outcome in zip(self.futures.futures, self.futures.outcomes(), strict=True)
        ]
        span: dict[str, Any] = {"frame": self.verdict.first, "last": self.verdict.last, "same": self.verdict.same}
        span |= {"notes": [*self.notes, *self.verdict.changes, *self.verdict.notes]}
        return span | {"futures": told, "out": str(self.out) if self.out else None}


def fork(
    replay: Replay,
    frame: int,
    branches: Sequence[Sequence[str]],
    *,
    until: float | None = None,
    out: Path | None = None,
) -> Forks:
    """Simulate a recording from a frame on as it was, and beside it each branch, after its assignments.

    ``until`` (s of simulated time) is the end of the recording by default, or a second after the frame. What code
    outside did between two steps is done to all but those with steps of another length, of which a note tells. ``out``
    records all, the branches as ghosts. Raises CaromError for a frame that is not recorded, an end before it, and
    assignments that cannot be.
    """
    base = replay.loaded_at(frame)
    dt = base.simulation.settings.dt
    last = max(replay.last, frame + frames_of(LATER, dt)) if until is None else frames_of(until, dt)
    if last <= frame:
        raise CaromError(f"--until: must come after frame {frame} at {frame * dt:g} s; received {until:g} s")
    state = take_snapshot(base.simulation.world)
    named = [(RECORDED, base.simulation)]
    for texts in branches:
        simulation = replay.loaded().simulation
        restore_snapshot(simulation.world, state)
        for text in texts:
            assign(simulation, text, "--set")
        named.append(("; ".join(texts), simulation))

    def redo(simulation: Simulation) -> None:
        if simulation.settings.dt == dt:  # by frames, which others count otherwise
            replay.redo(simulation.world)

    later = [number for number in replay.recording.edits() if frame < number <= last]
    others = [name for name, simulation in named if simulation.settings.dt != dt]
    notes = [_not_redone(name, later) for name in others if later]
    futures = Futures(named, redo)
    observers: list[Observer] = [futures]
    if out:
        stated = {"title": replay.title, "source": replay.source, "files": replay.files}
        observers.append(recorder_of(base, shot_of(base, None), out, every=1, **stated))
    return Forks(futures, retrace(replay, base, last, observers), out, notes)


def _not_redone(name: str, frames: list[int]) -> str:
    """Return in words that a branch lacks what code outside did before these frames."""
    before = f"frame {frames[0]}" if len(frames) == 1 else f"{len(frames)} frames from {frames[0]} on"
    return f"{name}: what code outside did before {before} is not done again there, since its steps are others"
