"""Replay: a recording simulated again, from nothing but what is in it."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from carom.ecs import Snapshot, World, restore_snapshot, snapshot_from_bytes, state_hash
from carom.ecs.component import Record
from carom.ecs.errors import CaromError, SnapshotError
from carom.ecs.explain import explain
from carom.systems.settings import Settings
from carom.systems.simulation import Simulation
from carom.tools.recorder import about
from carom.tools.recorder.edits import ENTITY
from carom.tools.recording import SavedState, open_recording
from carom.worlds.builder import LoadedWorld, load_text


class Replay:
    """What a recording needs to run again: ``Replay("rec.rrd").simulation_at(frame=400)`` is a live `Simulation`.

    ``title``, ``source`` and ``files`` are those of the recorder, ``first`` and ``last`` the frames it holds,
    ``states`` its snapshots by frame, ``notes`` what a user should know. Raises CaromError for a file that cannot be
    read, or that holds no world file or no snapshot; what is wrong with these is told when they are used.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self.recording, self.notes = open_recording(self.path)
        self.stated = self.recording.static.get(f"/{about.PATH}", {})
        self.title, self.source = (str(self.stated.get(key, [""])[0]) for key in ("title", "world_file"))
        held = self.recording.static.get(f"/{about.FILES}", {"name": [], "content": []})
        self.files: dict[str, bytes] = dict(zip(held["name"], held["content"], strict=True))
        self.states = {saved.frame: saved for saved in self.recording.saved_states()}
        if not (self.source and self.states and self.recording.frames):
            missing = "snapshot to begin from" if self.source else "world file"
            raise CaromError(
                f"{path} holds no {missing}, so that it cannot be simulated again; "
                f"record a world file: carom run WORLD --record {path}"
            )
        self.first, self.last = min(self.states), max(*self.states, *self.recording.frames)

    def loaded(self) -> LoadedWorld:
        """Return the world as its file makes it, with the recorded settings; raise WorldError when it does not load."""
        settings: dict[str, Any] = {}
        for field in fields(Settings):
            if field.name in self.stated:
                value = self.stated[field.name]
                settings[field.name] = tuple(value) if isinstance(field.default, tuple) else value[0]
        with TemporaryDirectory() as folder:
            files = {}
            for number, (word, content) in enumerate(self.files.items()):
                files[word] = Path(folder, f"{number}{Path(word).suffix}")
                files[word].write_bytes(content)
            return load_text(self.source, f"{self.path}, its world file", Path(folder), files=files, **settings)

    def loaded_at(self, frame: int) -> LoadedWorld:
        """Return the world in a frame, from the nearest snapshot before; raise CaromError for one not recorded."""
        if not self.first <= frame <= self.last:
            raise CaromError(f"{self.path} does not hold frame {frame}, but frames {self.first} to {self.last}")
        loaded = self.loaded()
        saved = self.states[max(number for number in self.states if number <= frame)]
        self.restore(loaded.simulation.world, saved)
        for _ in range(frame - saved.frame):
            self.redo(loaded.simulation.world)
            loaded.simulation.step()
        return loaded

    def simulation_at(self, frame: int) -> Simulation:
        """Return a simulation in that frame, which may go on in any way; raise CaromError like `loaded_at`."""
        return self.loaded_at(frame).simulation

    def redo(self, world: World) -> None:
        """Write what code outside the step wrote before the next one, to those of them who live here."""
        for key, columns in self.recording.writes(world.frame + 1).items():
            kind = Record.registry[key]
            here = world.slots.live(columns[ENTITY])
            rows = world.slots.rows(columns[ENTITY][here])
            with world.edit(kind) as table:
                for name, column in kind.columns.items():
                    if name in columns:
                        values = np.asarray(columns[name], column.dtype).reshape(len(here), *column.shape)
                        getattr(table, name)[rows] = values[here]

    def snapshot(self, world: World, saved: SavedState) -> Snapshot:
        """Return a snapshot of the recording; raise SnapshotError when it is damaged or does not fit the world."""
        return snapshot_from_bytes(saved.state, world, self._name(saved))

    def restore(self, world: World, saved: SavedState) -> None:
        """Make a world what it was then, to the bit; raise SnapshotError when that cannot be."""
        restore_snapshot(world, self.snapshot(world, saved))
        self.confirm(world, saved)

    def confirm(self, world: World, saved: SavedState) -> None:
        """Raise SnapshotError when a world that is as a snapshot says does not have the hash recorded with it."""
        if state_hash(world) != saved.hash:
            raise SnapshotError(
                f"{self._name(saved)} is damaged: its hash is {state_hash(world)}, recorded with it is {saved.hash}"
            )

    def changes(self, simulation: Simulation) -> list[str]:
        """Return in words what else than the past of the recording a result may depend on and is not as it was."""
        here = about.versions_here()
        then = {name: value[0] for name, value in self.stated.items() if name in here or name.startswith("version_")}
        told = []
        for name in sorted(here.keys() | then.keys()):
            before, now = then.get(name, "none"), here.get(name, "none")
            if before != now:
                told.append(f"{name.removeprefix('version_')} was {before}, here it is {now}")
        frame = explain(simulation.schedule)
        recorded = self.stated.get("schedule", [frame])[0]  # an earlier carom did not record it
        if recorded != frame:
            were, are = _systems(recorded), _systems(frame)
            gone, new = ", ".join(sorted(were - are)), ", ".join(sorted(are - were))
            told.append(f"the step was another: systems only then: {gone or 'none'}; only here: {new or 'none'}")
        return told

    def _name(self, saved: SavedState) -> str:
        return f"{self.path}, the snapshot of frame {saved.frame},"


def _systems(table: str) -> set[str]:
    """Return the names of the systems in what `explain` has told."""
    return {line.split()[0] for line in table.partition("\n\n")[2].splitlines()}
