"""Retrace: a replay held against its recording, frame by frame, and the verdict."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field

import numpy as np

from carom.ecs import Difference, Transform, World, first_difference
from carom.systems.observer import Observer
from carom.tools.interrupt import deferred_interrupt
from carom.tools.recorder import about
from carom.tools.recording import Recording
from carom.tools.replay import Replay
from carom.tools.session import progress_bar
from carom.tools.visible import visible_rows
from carom.worlds.builder import LoadedWorld


@dataclass(frozen=True)
class Parting:
    """Where a replay parted from its recording, between two frames that were compared in full.

    ``seen`` is the first frame in which somebody, ``entity``, stands elsewhere; ``difference`` what differs in
    ``last``, None where the recording ends without a snapshot; ``edits`` what code outside
    the step did before which frame.
    """

    first: int
    last: int
    seen: int | None
    entity: str
    difference: Difference | None
    edits: dict[int, str]

    def text(self, dt: float) -> str:
        """Return it in words."""
        lines = [f"from {self.first * dt:.6g} s to {self.last * dt:.6g} s (frames {self.first} to {self.last}):"]
        lines += [f"code outside the step changed {what} before frame {frame}" for frame, what in self.edits.items()]
        if self.seen is not None:
            lines.append(f"seen first in frame {self.seen}, where '{self.entity}' is elsewhere")
        if self.difference is not None:
            lines.append(str(self.difference))
        return "\n    ".join(lines)


@dataclass
class Verdict:
    """What came of a replay: the frames, where it parted, and what is not as it was when the recording was made."""

    path: str
    first: int
    last: int
    dt: float
    full: int  # the last frame of which all state was compared
    partings: list[Parting] = field(default_factory=list)
    changes: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    @property
    def same(self) -> bool:
        """Tell whether every compared bit was the same."""
        return not self.partings

    def text(self) -> str:
        """Return the verdict for people."""
        if not self.same:
            found = "not the same; the first is what was recorded, the second what came out now"
        elif self.full == self.last:
            found = "the same, bit for bit"
        else:
            found = f"the same, bit for bit up to frame {self.full}, then in every recorded pose, rounded to float32"
        lines = [f"{self.path}: frames {self.first} to {self.last} simulated again: {found}"]
        lines += [f"  {parting.text(self.dt)}" for parting in self.partings]
        lines += [f"  changed: {change}" for change in self.changes]
        return "\n".join([*lines, *(f"  note: {note}" for note in self.notes)])


def retrace(replay: Replay, loaded: LoadedWorld, last: int, observers: Sequence[Observer] = ()) -> Verdict:
    """Step a world of a replay to a frame of its recording, holding it against that; return the verdict.

    After every snapshot it goes on from what was recorded there. Observers see the frames as the recording has them at
    snapshots and as they were simulated between.
    """
    simulation = loaded.simulation
    verdict = Verdict(str(replay.path), simulation.frame, last, simulation.settings.dt, simulation.frame)
    verdict.changes, verdict.notes = replay.changes(simulation), replay.notes
    tracer = Tracer(replay, verdict)
    with deferred_interrupt() as check, progress_bar(last - simulation.frame) as bar, ExitStack() as leaving:
        leaving.enter_context(np.errstate(all="ignore"))
        tracer.compare(simulation.world)
        for observer in observers:
            leaving.callback(observer.end, simulation)
            observer.begin(simulation)
        while simulation.frame < last:
            replay.redo(simulation.world)
            simulation.step()
            tracer.compare(simulation.world)
            for observer in observers:
                observer.observe(simulation)
            bar.update()
            check()
    tracer.finish()
    return verdict


class Tracer:
    """Compares poses of recorded frames, and all state where there is a snapshot."""

    def __init__(self, replay: Replay, verdict: Verdict) -> None:
        self._replay, self._verdict = replay, verdict
        self._recorded, self._edits = set(replay.recording.frames), replay.recording.edits()
        self._seen: tuple[int | None, str] = (None, "")

    def compare(self, world: World) -> None:
        """Hold a world against the recording of this frame; make it what a snapshot of it says."""
        frame = world.frame
        if self._seen[0] is None and frame in self._recorded:
            entity = elsewhere(self._replay.recording, world)
            self._seen = (None, "") if entity is None else (frame, entity)
        saved = self._replay.states.get(frame)
        if saved is None:
            return
        found = first_difference(self._replay.snapshot(world, saved), world)
        if found is None and self._seen[0] is None:
            self._replay.confirm(world, saved)
        else:
            self._part(frame, found)
            self._replay.restore(world, saved)
        self._verdict.full, self._seen = frame, (None, "")

    def finish(self) -> None:
        """Tell what was seen after the last snapshot."""
        if self._seen[0] is not None:
            self._part(self._verdict.last, None)

    def _part(self, last: int, found: Difference | None) -> None:
        first = self._verdict.full
        edits = {frame: done for frame, done in self._edits.items() if first < frame <= last}
        self._verdict.partings.append(Parting(first, last, *self._seen, found, edits))


def elsewhere(recording: Recording, world: World) -> str | None:
    """Return somebody visible whose pose is not as recorded, or who is on one side only; None for nobody."""
    rows = visible_rows(world)
    poses = recording.poses(world.frame)
    if "only" in recording.static.get(f"/{about.PATH}", {}):  # some were chosen, and others not recorded
        rows = rows[np.isin(world.entities(rows), list(poses))]
    handles = world.entities(rows).tolist()
    if strangers := poses.keys() ^ set(handles):
        stranger, names = min(strangers), recording.names(world.frame)
        return names[stranger] if stranger in names else world.name(stranger)
    if not handles:
        return None
    there = np.array([(*poses[handle].position, *poses[handle].rotation) for handle in handles], np.float32)
    here = np.concatenate([world[Transform].position[rows], world[Transform].rotation[rows]], axis=1).astype(np.float32)
    differs = (there != here).any(axis=1)
    return world.name(handles[int(differs.argmax())]) if differs.any() else None
