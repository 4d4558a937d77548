"""Stream: one Rerun recording, on disk, in a viewer that is running, or both, written in blocks of rows."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple
from zlib import crc32

import numpy as np

FRAME = "frame"
TIME = "sim_time"
SUBSTEP = "substep"  # counted from the start of the simulation; only where they are recorded

TITLE_LENGTH = 150  # characters of an application's name; Rerun takes 180 in all
PATIENCE = 10.0  # s in which a viewer must have taken what it was sent, or else it counts as gone


def application_id(title: str) -> str:
    """Return the name of a world's own application, since the viewer keeps one layout per application.

    Rerun takes ASCII letters, digits and ``:-_[]`` in it, others it would exchange, and warn. Where that is done here,
    a checksum keeps those of different titles apart.
    """
    plain = re.sub(r"[^A-Za-z0-9 :_\[\]-]", "-", title)[:TITLE_LENGTH]
    return f"carom: {plain}" if plain == title else f"carom: {plain} {crc32(title.encode()):08x}"


def own_path(root: str, name: str) -> str:
    """Return the path below another of what has this name, with marks before letters that mean something in paths."""
    import rerun

    return str(rerun.new_entity_path([*root.split("/"), name]))


class Stamp(NamedTuple):
    """When something is: the frame number and the simulated time in s."""

    frame: int
    time: float


class Stream:
    """Recording streams of its own (never Rerun's global one): one into a file, one into a viewer, or both.

    Rows are stamped with simulated time only: wall-clock timelines would make equal runs differ. A viewer that goes
    away is told of on stderr, and is sent nothing more. With ``substeps``, as many as a frame has, what belongs to a
    frame is on the timeline of substeps as well.
    """

    def __init__(self, title: str) -> None:
        self._title = title
        self._recordings: list[Any] = []
        self._viewer: Any = None
        self._url = ""
        self.substeps = 0

    def to_file(self, path: Path, blueprint: Any) -> None:
        """Write what follows into a file too."""
        recording = self._recording()
        recording.save(path, default_blueprint=blueprint)
        self._begin(recording)

    def to_viewer(self, url: str, blueprint: Any) -> None:
        """Send what follows to a viewer too, which listens there."""
        self._viewer, self._url = self._recording(), url
        self._viewer.connect_grpc(url, default_blueprint=blueprint)
        self._begin(self._viewer)

    def static(self, path: str, *archetypes: Any) -> None:
        """Write what holds at all times."""
        for recording in self._recordings:
            recording.log(path, *archetypes, static=True)

    def row(self, path: str, stamp: Stamp, *archetypes: Any) -> None:
        """Write one row."""
        for recording in self._recordings:
            recording.set_time(FRAME, sequence=stamp.frame)
            recording.set_time(TIME, duration=stamp.time)
            if self.substeps:
                recording.set_time(SUBSTEP, sequence=stamp.frame * self.substeps)
            recording.log(path, *archetypes)

    def rows(self, path: str, stamps: Sequence[Stamp], columns: Iterable[Any]) -> None:
        """Write one row per stamp at once, which costs a tenth of writing them singly."""
        import rerun

        frames = [stamp.frame for stamp in stamps]
        indexes = [rerun.TimeColumn(FRAME, sequence=frames)]
        if self.substeps:
            indexes.append(rerun.TimeColumn(SUBSTEP, sequence=[frame * self.substeps for frame in frames]))
        self._send(path, indexes, stamps, columns)

    def substep_rows(self, path: str, stamps: Sequence[Stamp], columns: Iterable[Any]) -> None:
        """Write one row per stamp, which counts substeps, beside the timeline of frames."""
        import rerun

        self._send(path, [rerun.TimeColumn(SUBSTEP, sequence=[stamp.frame for stamp in stamps])], stamps, columns)

    def flush(self) -> None:
        """Hand everything written so far to the operating system, where a killed process cannot lose it."""
        for recording in [*self._recordings]:
            if recording is not self._viewer:
                recording.flush()
                continue
            try:
                recording.flush(timeout_sec=PATIENCE)
            except RuntimeError:  # what Rerun raises of a connection that broke, and of one that stalls
                self._recordings.remove(recording)
                print(f"warning: the viewer at {self._url} has gone away; the run goes on", file=sys.stderr)

    def close(self) -> None:
        """Finish the file, and send the viewer what is left."""
        self.flush()
        for recording in self._recordings:
            recording.disconnect()

    def _send(self, path: str, indexes: list[Any], stamps: Sequence[Stamp], columns: Iterable[Any]) -> None:
        import rerun

        nanoseconds = np.rint(1e9 * np.array([stamp.time for stamp in stamps]))
        times = rerun.TimeColumn(
            TIME, duration=nanoseconds.astype("timedelta64[ns]")
        )  # such an array is taken as it is
        columns = list(columns)
        for recording in self._recordings:
            recording.send_columns(path, indexes=[*indexes, times], columns=columns)

    def _recording(self) -> Any:
        import rerun

        return rerun.RecordingStream(application_id(self._title))

    def _begin(self, recording: Any) -> None:
        recording.send_recording_name(self._title)
        recording.set_log_time_enabled(False)
        recording.set_log_tick_enabled(False)
        self._recordings.append(recording)
