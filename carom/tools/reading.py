"""Reading: the chunks of an .rrd file, put in order of path, component and frame."""

from __future__ import annotations

import warnings
from bisect import bisect_right
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs.errors import CaromError
from carom.tools.recorder.stream import FRAME, SUBSTEP, TIME
from carom.tools.recorder.tracks import bodies, happenings

NANOSECONDS = 1e-9
ROW_ID = "rerun.controls.RowId"


class Line(NamedTuple):
    """A line of the log: simulated time in s, level, text, and the frame at whose end it was told."""

    time: float
    level: str
    text: str
    frame: int


@dataclass
class Series:
    """The values of one component of one path, in order of frame; a row holds until the next."""

    frames: list[int] = field(default_factory=list)
    values: list[Any] = field(default_factory=list)

    def at(self, frame: int) -> tuple[int, Any] | None:
        """Return the frame and value of the last row not after ``frame``."""
        place = bisect_right(self.frames, frame)
        return (self.frames[place - 1], self.values[place - 1]) if place else None


@dataclass
class Timeline:
    """Rows by path and component, and the time (s) of each frame, or of each substep."""

    times: dict[int, float] = field(default_factory=dict)
    series: dict[tuple[str, str], Series] = field(default_factory=lambda: defaultdict(Series))


@dataclass
class Written(Timeline):
    """What was written: what holds at all times, the log, rows of frames, and poses by substep."""

    static: dict[str, dict[str, Any]] = field(default_factory=lambda: defaultdict(dict))
    lines: list[Line] = field(default_factory=list)
    substeps: Timeline = field(default_factory=Timeline)


def read(path: Path) -> Written:
    """Return what a file holds; raise CaromError where Rerun cannot read it, warn of one whose writer was killed."""
    written = Written()
    for chunk in _chunks(path):
        batch = chunk.to_record_batch()
        columns = {name: batch.column(name) for name in batch.schema.names}
        components = [name for name in columns if name not in (FRAME, TIME, SUBSTEP, ROW_ID)]
        if chunk.is_static:
            written.static[chunk.entity_path] |= {name: columns[name][0].as_py() for name in components}
            continue
        if SUBSTEP in columns and chunk.entity_path.startswith(f"/{bodies.ROOT}/"):
            _take(written.substeps, SUBSTEP, chunk.entity_path, columns, components)
        if FRAME not in columns:
            continue
        if chunk.entity_path == f"/{happenings.PATH}":
            frames, times = columns[FRAME].to_pylist(), _seconds(columns[TIME])
            texts, levels = columns["TextLog:text"].to_pylist(), columns["TextLog:level"].to_pylist()
            for frame, at, level, text in zip(frames, times, levels, texts, strict=True):
                written.lines.append(Line(float(at), level[0], text[0], frame))
        else:
            _take(written, FRAME, chunk.entity_path, columns, components)
    written.lines.sort(key=lambda line: line.frame)
    for series in (*written.series.values(), *written.substeps.series.values()):
        order = np.argsort(np.array(series.frames), kind="stable")
        series.frames = [series.frames[i] for i in order]
        series.values = [series.values[i] for i in order]
    return written


def _take(timeline: Timeline, name: str, path: str, columns: dict[str, Any], components: list[str]) -> None:
    """Take the rows of a chunk by the numbers they have on a timeline."""
    numbers = columns[name].to_pylist()
    timeline.times |= dict(zip(numbers, map(float, _seconds(columns[TIME])), strict=True))
    for component in components:
        series = timeline.series[path, component]
        for number, value in zip(numbers, columns[component], strict=True):
            if value.is_valid:
                series.frames.append(number)
                series.values.append(_array(value))


def _seconds(times: Any) -> npt.NDArray[np.float64]:
    seconds: npt.NDArray[np.float64] = times.cast("int64").to_numpy() * NANOSECONDS
    return seconds


def _chunks(path: Path) -> list[Any]:
    from rerun.chunk import RrdReader

    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        try:
            chunks: list[Any] = RrdReader(str(path)).stream().to_chunks()
        except (RuntimeError, ValueError) as fault:
            raise CaromError(f"cannot read {path}: {fault}; where it was cut off, `carom salvage` mends it") from None
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
