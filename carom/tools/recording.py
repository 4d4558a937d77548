"""Recording: an .rrd file of the recorder read back into arrays."""

from __future__ import annotations

import warnings
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs.errors import CaromError, did_you_mean
from carom.systems.edits import LIVES, RESTORED
from carom.tools.reading import Series, read
from carom.tools.recorder import about, edits, snapshots
from carom.tools.recorder.tracks import bodies, contacts, plots
from carom.tools.tables import makers
from carom.tools.tables.source import RecordedTable, Source


class Pose(NamedTuple):
    """Position (3,) in m and rotation (4,) xyzw of an entity's origin, float32 as recorded."""

    position: npt.NDArray[np.float32]
    rotation: npt.NDArray[np.float32]


class SavedState(NamedTuple):
    """A snapshot in full precision with the hash of that state; see `snapshot_from_bytes`."""

    frame: int
    state: bytes
    hash: str


class Recording:
    """What a recording holds, by frame and entity.

    Raises CaromError when Rerun cannot read the file; warns of one whose writer was killed, and reads what is there.
    """

    def __init__(self, path: str | Path) -> None:
        written = read(Path(path))
        self.static, self.times, self.lines, self._series = written.static, written.times, written.lines, written.series
        self._substeps = written.substeps
        counts = self._series[f"/{plots.COUNTS}/bodies", "Scalars:scalars"]
        self.frames: list[int] = counts.frames

    def poses(self, frame: int) -> dict[int, Pose]:
        """Return the pose of every visible entity in a frame, by entity handle."""
        found = {}
        for path, members in self._groups(frame):
            translations = self._series[path, "InstancePoses3D:translations"].at(frame)
            quaternions = self._series[path, "InstancePoses3D:quaternions"].at(frame)
            if translations is None or quaternions is None:
                continue  # killed between the two writes
            for entity, position, rotation in zip(members, translations[1], quaternions[1], strict=True):
                found[entity] = Pose(position, rotation)
        return found

    def names(self, frame: int) -> dict[int, str]:
        """Return the name of every visible entity in a frame, by entity handle."""
        found: dict[int, str] = {}
        for path, members in self._groups(frame):
            names = self._series[path, "name"].at(frame)
            if names:
                found |= dict(zip(members, names[1], strict=True))
        return found

    def place(self, entity: int, frame: int) -> tuple[str, list[int]]:
        """Return the path at which an entity is visible in a frame, and all who are: instance i is the i-th of them.

        Raises CaromError for one that is not.
        """
        for path, members in self._groups(frame):
            if entity in members:
                return path, members
        raise CaromError(f"entity {entity} is not visible in frame {frame}")

    def _groups(self, frame: int) -> Iterator[tuple[str, list[int]]]:
        """Yield the path of each group of entities that is there in a frame, and their handles."""
        for (path, component), series in list(self._series.items()):
            if component != "entity" or not path.startswith(f"/{bodies.ROOT}/"):
                continue
            members = series.at(frame)
            cleared = self._series[path, "Clear:is_recursive"].at(frame)
            if members is not None and (cleared is None or cleared[0] < members[0]):
                yield path, [int(handle) for handle in members[1]]

    def contacts(self, frame: int) -> dict[str, npt.NDArray[Any]]:
        """Return the contacts of a recorded frame: points float32, colliders int64, speed float32, the rest float64."""
        columns = {
            "point": "Points3D:positions",
            **{name: name for name in ("a", "b", "normal", "depth", "impulse", "speed")},
        }
        rows = {name: self._series[f"/{contacts.POINTS}", component].at(frame) for name, component in columns.items()}
        return {name: row[1] for name, row in rows.items() if row is not None}

    def plot(self, path: str) -> dict[int, float]:
        """Return a curve such as ``plots/energy/total`` by frame."""
        series = self._series[f"/{path}", "Scalars:scalars"]
        return {frame: float(value[0]) for frame, value in zip(series.frames, series.values, strict=True)}

    def saved_states(self) -> list[SavedState]:
        """Return the snapshots in order of frame."""
        states = self._series[f"/{snapshots.PATH}", "state"]
        hashes = self._series[f"/{snapshots.PATH}", "hash"]
        rows = zip(states.frames, states.values, hashes.values, strict=True)
        return [SavedState(frame, state[0], text[0]) for frame, state, text in rows]

    def edits(self) -> dict[int, str]:
        """Return what code outside the step did before it, by the frame it led to: components, who lives."""
        done = self._series[f"/{edits.PATH}", "done"]
        return {frame: str(text[0]) for frame, text in zip(done.frames, done.values, strict=True)}

    def writes(self, frame: int) -> dict[str, dict[str, Any]]:
        """Return what code outside the step wrote before it, by component and column, all rows of whom it wrote to.

        Nothing where also somebody came or went, or a snapshot was restored, which a recording does not hold.
        """
        done = set(self.edits().get(frame, LIVES).split(", "))
        found: dict[str, dict[str, Any]] = defaultdict(dict)
        if not done & {LIVES, RESTORED}:
            for (path, name), series in list(self._series.items()):
                row = series.at(frame) if path.startswith(f"/{edits.PATH}/") else None
                if row and row[0] == frame:
                    found[path.rpartition("/")[2]][name] = row[1]
        return found

    def table(self, name: str) -> RecordedTable:
        """Return a table such as ``contacts``, a row per frame and contact, for Arrow, pandas and polars.

        Raises CaromError for one that is not there.
        """
        found = makers(self._source())
        if name not in found:
            hint = did_you_mean(name, found)
            raise CaromError("; ".join(filter(None, (f"no table '{name}'", f"accepted: {', '.join(found)}", hint))))
        return RecordedTable(found[name]())

    def tables(self) -> list[str]:
        """Return the names of all tables."""
        return list(makers(self._source()))

    def _source(self) -> Source:
        source, numbers = (
            Source(_written(self._series), self.frames, self.times, self.lines),
            sorted(self._substeps.times),
        )
        if not numbers:
            return source
        count = int(self.static[f"/{about.PATH}"]["substeps"][0])
        within = Source(_written(self._substeps.series), numbers, self._substeps.times, [])
        return replace(source, substeps=within, substep_count=count)


def _written(series: dict[tuple[str, str], Series]) -> dict[tuple[str, str], Series]:
    return {key: rows for key, rows in series.items() if rows.frames}


def open_recording(path: Path) -> tuple[Recording, list[str]]:
    """Return what a file holds, and what was told of it; raise CaromError when it is not there or cannot be read."""
    refuse_missing(path)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        recording = Recording(path)
    return recording, [str(warning.message) for warning in told]


def refuse_missing(path: Path) -> None:
    """Raise CaromError where there is no file."""
    if not path.is_file():
        raise CaromError(f"no recording at {path}; make one with: carom run billiards --record {path}")
