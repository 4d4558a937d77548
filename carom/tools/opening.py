"""Opening: the one command that opens a run where something went wrong, and what is told of an expectation there."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from functools import cached_property
from pathlib import Path
from typing import Any

from carom.tools.recording import Recording
from carom.worlds.breaks import NOT_FINITE
from carom.worlds.builder import LoadedWorld
from carom.worlds.errors import Path as Steps
from carom.worlds.expectation import Outcome


def place_of(loaded: LoadedWorld, name: str) -> str:
    """Return where in its files an entity is written, ``world.yaml:7:5``, or else the file."""
    base = re.split(r"[.\[]", name)[0]
    found = (path for path, words in _stated(loaded.source.data) if words.get("name") == base)
    return next(map(loaded.source.written_at, found), loaded.path)


def _stated(data: dict[str, Any]) -> Iterator[tuple[Steps, dict[str, Any]]]:
    """Yield where entities are stated, with their words: those of the start, and those whom events bring."""
    for index, words in enumerate(data.get("entities") or []):
        if isinstance(words, dict):
            yield ("entities", index), words
    for index, event in enumerate(data.get("events") or []):
        if isinstance(event, dict) and isinstance(event.get("spawn"), dict):
            yield ("events", index, "spawn"), event["spawn"]


def viewing(recording: Recording, path: str, frame: int, names: Sequence[str]) -> str:
    """Return the command that shows a frame of a recording, and selects the first of these names that is seen there."""
    shown = set(recording.names(frame).values())
    selected = next((["--select", name] for name in names if name in shown), [])
    return shlex.join(["carom", "view", path, "--frame", str(frame), *selected])


class Opening:
    """The commands for a run of ``world``, the words that name it, with ``options`` of the command line.

    A frame is opened in the recording, where there is one that holds it, or else as a prompt on the world before it.
    """

    def __init__(
        self, loaded: LoadedWorld, world: str, options: Sequence[str] = (), recording: Path | None = None
    ) -> None:
        self._loaded, self._world, self._options, self._path = loaded, world, options, recording

    def command(self, frame: int, names: Sequence[str], conditions: Sequence[str] = ()) -> str:
        """Return what opens a frame, or what meets the conditions first where no recording holds it."""
        recording = self._recording
        if recording and recording.frames[0] <= frame <= recording.frames[-1]:
            return viewing(recording, str(self._path), frame, names)
        conditions = conditions or [f"frame {max(frame, 1)}"]
        stops = [word for text in conditions for word in ("--break", text)]
        return shlex.join(["carom", "run", self._world, *stops, *self._options, "--pdb"])

    def of_no_number(self) -> str:
        """Return what opens a prompt before the step that makes what is no number."""
        return self.command(0, (), [NOT_FINITE])

    def lines(self, failed: Outcome) -> list[str]:
        """Return what is told of a failure: where it is written, the frame, whom of, and what opens it there."""
        of = [f"  {place_of(self._loaded, name)}: '{name}'" for name in failed.entities]
        return [f"{failed.file}: {failed}", *of, f"  open it with: {self._command(failed)}"]

    def told(self, failed: Outcome) -> dict[str, Any]:
        """Return the same for programs."""
        files = [place_of(self._loaded, name) for name in failed.entities]
        return asdict(failed) | {"files": files, "command": self._command(failed)}

    def _command(self, failed: Outcome) -> str:
        assert failed.frame is not None, "only what has failed is opened"
        return self.command(failed.frame, failed.entities)

    @cached_property
    def _recording(self) -> Recording | None:
        return Recording(self._path) if self._path else None
