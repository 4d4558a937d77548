"""Stream: one Rerun recording on disk, written in blocks of rows."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple
from zlib import crc32

import numpy as np

FRAME = "frame"
TIME = "sim_time"


TITLE_LENGTH = 150  # characters of an application's name; Rerun takes 180 in all


def application_id(title: str) -> str:
    """Return the name of a world's own application, since the viewer keeps one layout per application.

    Rerun takes ASCII letters, digits and ``:-_[]`` in it, others it would exchange, and warn. Where that is done here,
    a checksum keeps those of different titles apart.
    """
    plain = re.sub(r"[^A-Za-z0-9 :_\[\]-]", "-", title)[:TITLE_LENGTH]
    return f"carom: {plain}" if plain == title else f"carom: {plain} {crc32(title.encode()):08x}"


class Stamp(NamedTuple):
    """When something is: the frame number and the simulated time in s."""

    frame: int
    time: float


class Stream:
    """A recording stream of its own (never Rerun's global one) into one file.

    Rows are stamped with simulated time only: wall-clock timelines would make equal runs differ.
    """

    def __init__(self, path: Path, title: str, blueprint: Any) -> None:
        import rerun

        self._recording = rerun.RecordingStream(application_id(title))
        self._recording.save(path, default_blueprint=blueprint)
        self._recording.send_recording_name(title)
        self._recording.set_log_time_enabled(False)
        self._recording.set_log_tick_enabled(False)

    def static(self, path: str, *archetypes: Any) -> None:
        """Write what holds at all times."""
        self._recording.log(path, *archetypes, static=True)

    def row(self, path: str, stamp: Stamp, *archetypes: Any) -> None:
        """Write one row."""
        self._recording.set_time(FRAME, sequence=stamp.frame)
        self._recording.set_time(TIME, duration=stamp.time)
        self._recording.log(path, *archetypes)

    def rows(self, path: str, stamps: Sequence[Stamp], columns: Iterable[Any]) -> None:
        """Write one row per stamp at once, which costs a tenth of writing them singly."""
        import rerun

        frames, times = zip(*stamps, strict=True)
        nanoseconds = np.rint(1e9 * np.array(times)).astype("timedelta64[ns]")  # an array of these is taken as it is
        indexes = [rerun.TimeColumn(FRAME, sequence=frames), rerun.TimeColumn(TIME, duration=nanoseconds)]
        self._recording.send_columns(path, indexes=indexes, columns=columns)

    def flush(self) -> None:
        """Hand everything written so far to the operating system, where a killed process cannot lose it."""
        self._recording.flush()

    def close(self) -> None:
        """Finish the file."""
        self._recording.disconnect()
