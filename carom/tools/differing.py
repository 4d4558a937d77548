"""Differing: where two runs part, in which system, and whether what parts them grew or came in again and again."""

from __future__ import annotations

from dataclasses import fields

import numpy as np

from carom.ecs import (
    SnapshotError,
    first_difference,
    restore_snapshot,
    state_hash,
    take_snapshot,
)
from carom.systems.divergence import OUTSIDE, first_divergence
from carom.systems.settings import Settings
from carom.tools.parted import Apart, Comparison
from carom.tools.retrace import elsewhere
from carom.tools.side import Side

NOT_HERE = (
    "not by rules that are here: from frame {good} both go on alike, so that no system can be named; that takes the "
    "code by which they differ, installed where this is run"
)
LOOKS = 8  # frames after the first in which both are given the same state again


def compare(a: Side, b: Side) -> Comparison:
    """Hold two runs against each other; where they part, simulate both again from the last state they share."""
    frames = _shared_frames(a, b)
    made = Comparison(a.name, b.name, a.simulation.settings.dt, frames[0], frames[-1], notes=_notes(a, b))
    good = None
    for frame in frames:
        if a.hash_at(frame) != b.hash_at(frame):
            _narrow(made, a, b, good, frame)
            _follow(made, a, b, [later for later in frames if later >= frame])
            break
        made.good = good = frame
    return made


def _shared_frames(a: Side, b: Side) -> list[int]:
    """Return the frames of which all state of both is to be had: those of recordings, of worlds one a second."""
    last = min(a.last, b.last)
    if a.frames is None and b.frames is None:
        every = max(1, round(1.0 / a.simulation.settings.dt))
        return [*range(0, last, every), last]
    held = [set(side.frames) for side in (a, b) if side.frames is not None]
    shared = sorted(frame for frame in set.intersection(*held) if frame <= last)
    if not shared:
        raise SnapshotError(f"{a.name} and {b.name} hold no snapshot of the same frame; record both from the start")
    return shared


def _notes(a: Side, b: Side) -> list[str]:
    notes = [*a.notes, *b.notes]
    one, other = a.simulation.settings, b.simulation.settings
    for name in (entry.name for entry in fields(Settings)):
        if getattr(one, name) != getattr(other, name):
            notes.append(f"{name} is {getattr(one, name)} in the first and {getattr(other, name)} in the second")
    for side in (a, b):
        if side.replay:
            notes += [f"{side.name}: {change}" for change in side.replay.changes(side.simulation)]
    return notes


def _narrow(made: Comparison, a: Side, b: Side, good: int | None, bad: int) -> None:
    """Find the first difference between the last state that is shared and the first that is not."""
    made.difference = first_difference(a.state_at(bad), b.state_at(bad))
    if good is None:
        made.how, made.reproduced = "there from the start", False
        return
    made.start = made.good = good
    for side in (a, b):
        side.go_to(good)
    found = first_divergence(a.simulation, b.simulation, bad - good, lambda: any([a.redo(), b.redo()]))
    if found is None:
        made.how, made.reproduced = NOT_HERE.format(good=good), False
        made.notes += [note for side in (a, b) if (note := _unlike_its_recording(side, good, bad))]
        return
    made.difference, shared = found, found.frame - (found.phase != OUTSIDE)
    made.good = shared
    made.apart.append(Apart.of(take_snapshot(a.simulation.world), take_snapshot(b.simulation.world)))
    looked, again = _look_again(a, b, shared + 1, bad)
    of = f"{looked} later frame{'' if looked == 1 else 's'}"
    if again:
        made.how = f"injected: from the same state both part again in {again} of {of}"
    elif looked:
        made.how = f"grew: it came in once; from the same state both stay alike in {of}"
    else:
        made.how = f"injected in frame {found.frame}, after which no state is known"


def _look_again(a: Side, b: Side, first: int, last: int) -> tuple[int, int]:
    """Give both the state of the first before some later frames; return how many, and in how many they part again."""
    wanted = set(np.linspace(first + 1, last, LOOKS).astype(int).tolist()) if last > first else set()
    looked = again = 0
    while a.simulation.frame < last:
        before = take_snapshot(a.simulation.world)
        a.step()
        if a.simulation.frame not in wanted:
            continue
        try:
            restore_snapshot(b.simulation.world, before)
        except SnapshotError:
            break  # the two worlds are not built alike
        b.step()
        looked += 1
        again += state_hash(a.simulation.world) != state_hash(b.simulation.world)
    return looked, again


def _unlike_its_recording(side: Side, good: int, bad: int) -> str:
    """Return in words where a side, simulated again, leaves its own recording; empty where it does not."""
    if side.replay is None:
        return ""
    side.go_to(good)
    recorded = set(side.replay.recording.frames)
    while side.simulation.frame < bad:
        side.step()
        frame = side.simulation.frame
        who = elsewhere(side.replay.recording, side.simulation.world) if frame in recorded else None
        if who is not None:
            return f"{side.name} comes out otherwise here from frame {frame} on, where '{who}' is elsewhere"
    if state_hash(side.simulation.world) != side.replay.states[bad].hash:
        return f"{side.name} comes out otherwise here by frame {bad}, in what is no pose"
    return ""


def _follow(made: Comparison, a: Side, b: Side, frames: list[int]) -> None:
    """Tell how far apart both are at the first state of which all is known, and at the last."""
    known = frames if a.frames is not None and b.frames is not None else frames[:1]
    made.apart += [Apart.of(a.state_at(frame), b.state_at(frame)) for frame in dict.fromkeys((known[0], known[-1]))]
