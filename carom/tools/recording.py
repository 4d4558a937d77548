"""Recording: an .rrd file of the recorder read back into arrays."""

from __future__ import annotations

import warnings
from bisect import bisect_right
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.tools.recorder import bodies, contacts, happenings, plots, snapshots
from carom.tools.recorder.stream import FRAME, TIME

NANOSECONDS = 1e-9
ROW_ID = "rerun.controls.RowId"


class Pose(NamedTuple):
    """Position (3,) in m and rotation (4,) xyzw of an entity's origin, float32 as recorded."""

    position: npt.NDArray[np.float32]
    rotation: npt.NDArray[np.float32]


class Line(NamedTuple):
    """A line of the log: simulated time in s, level and text."""

    time: float
    level: str
    text: str


class SavedState(NamedTuple):
    """A snapshot in full precision with the hash of that state; see `snapshot_from_bytes`."""

    frame: int
    state: bytes
    hash: str


@dataclass
class Series:
    """The values of one component of one path, in order of frame; a row holds until the next."""

    frames: list[int] = field(default_factory=list)
    values: list[Any] = field(default_factory=list)

    def at(self, frame: int) -> tuple[int, Any] | None:
        """Return the frame and value of the last row not after ``frame``."""
        place = bisect_right(self.frames, frame)
        return (self.frames[place - 1], self.values[place - 1]) if place else None


class Recording:
    """What a recording holds, by frame and entity.

    Raises RuntimeError when Rerun cannot read the file; warns of one whose writer was killed, and reads what is there.
    """

    def __init__(self, path: str | Path) -> None:
        self.static: dict[str, dict[str, Any]] = defaultdict(dict)
        self.times: dict[int, float] = {}
        self.lines: list[Line] = []
        self._series: dict[tuple[str, str], Series] = defaultdict(Series)
        self._read(Path(path))
        counts = self._series[f"/{plots.COUNTS}/bodies", "Scalars:scalars"]
        self.frames: list[int] = counts.frames

    def poses(self, frame: int) -> dict[int, Pose]:
        """Return the pose of every visible entity in a frame, by entity handle."""
        found = {}
        for (path, component), series in list(self._series.items()):
            if component != "entity" or not path.startswith(f"/{bodies.ROOT}/"):
                continue
            members = series.at(frame)
            cleared = self._series[path, "Clear:is_recursive"].at(frame)
            if members is None or (cleared is not None and cleared[0] >= members[0]):
                continue
            translations = self._series[path, "InstancePoses3D:translations"].at(frame)
            quaternions = self._series[path, "InstancePoses3D:quaternions"].at(frame)
            if translations is None or quaternions is None:
                continue  # killed between the two writes
            for entity, position, rotation in zip(members[1], translations[1], quaternions[1], strict=True):
                found[int(entity)] = Pose(position, rotation)
        return found

    def names(self, frame: int) -> dict[int, str]:
        """Return the name of every visible entity in a frame, by entity handle."""
        found: dict[int, str] = {}
        for (path, component), series in list(self._series.items()):
            members = series.at(frame) if component == "entity" else None
            names = self._series[path, "name"].at(frame) if members else None
            if members and names:
                found |= dict(zip(map(int, members[1]), names[1], strict=True))
        return found

    def contacts(self, frame: int) -> dict[str, npt.NDArray[Any]]:
        """Return the contacts of a recorded frame: points float32, both colliders int64, the rest float64."""
        columns = {"point": "Points3D:positions", **{name: name for name in ("a", "b", "normal", "depth", "impulse")}}
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

    def _read(self, path: Path) -> None:
        lines: list[tuple[int, Line]] = []
        for chunk in _chunks(path):
            batch = chunk.to_record_batch()
            columns = {name: batch.column(name) for name in batch.schema.names}
            components = [name for name in columns if name not in (FRAME, TIME, ROW_ID)]
            if chunk.is_static:
                self.static[chunk.entity_path] |= {name: columns[name][0].as_py() for name in components}
                continue
            if FRAME not in columns:
                continue
            frames = columns[FRAME].to_pylist()
            times = columns[TIME].cast("int64").to_numpy() * NANOSECONDS
            if chunk.entity_path == f"/{happenings.PATH}":
                texts, levels = columns["TextLog:text"].to_pylist(), columns["TextLog:level"].to_pylist()
                for frame, at, level, text in zip(frames, times, levels, texts, strict=True):
                    lines.append((frame, Line(float(at), level[0], text[0])))
                continue
            self.times |= dict(zip(frames, map(float, times), strict=True))
            for name in components:
                series = self._series[chunk.entity_path, name]
                for frame, value in zip(frames, columns[name], strict=True):
                    if value.is_valid:
                        series.frames.append(frame)
                        series.values.append(_array(value))
        self.lines = [line for _, line in sorted(lines, key=lambda item: item[0])]
        for series in self._series.values():
            order = np.argsort(np.array(series.frames), kind="stable")
            series.frames = [series.frames[i] for i in order]
            series.values = [series.values[i] for i in order]


def _chunks(path: Path) -> list[Any]:
    from rerun.chunk import RrdReader

    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        chunks: list[Any] = RrdReader(str(path)).stream().to_chunks()
    for warning in told:
        text = str(warning.message)
        if "footer" in text:  # Rerun takes an unfinished file for one of an old format
            text = f"{path} was not finished: the run that wrote it was killed; its last second may be missing"
        warnings.warn(text, stacklevel=4)
    return chunks


def _array(value: Any) -> Any:
    """Return the instances of one row: numbers as an array (n, *width), others as a list."""
    import pyarrow

    items = value.values
    if pyarrow.types.is_fixed_size_list(items.type):
        width = items.type.list_size
        return items.flatten().to_numpy(zero_copy_only=False).reshape(-1, width)
    if pyarrow.types.is_floating(items.type) or pyarrow.types.is_integer(items.type):
        return items.to_numpy(zero_copy_only=False)
    return items.to_pylist()
