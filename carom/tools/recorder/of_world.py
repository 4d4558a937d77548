"""Of a world: the recorder that a world file's own words make."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from carom.tools.filming import Shot
from carom.tools.recorder.recorder import Recorder
from carom.tools.rigs import rigs_of
from carom.worlds.builder import LoadedWorld


def recorder_of(loaded: LoadedWorld, shot: Shot, path: Path | None, **options: Any) -> Recorder:
    """Return a recorder with the world's text, files and cameras, whose view begins as the shot is taken.

    ``options`` are those of `Recorder`, and go before what the world states.
    """
    stated: dict[str, Any] = {
        "title": loaded.name or Path(loaded.path).stem,
        "source": loaded.source_text,
        "files": loaded.contents(),
        "camera": shot.camera(loaded.simulation.world),
        "cameras": rigs_of(loaded),
        "aspect": shot.width / shot.height,
    }
    return Recorder(path, **stated | options)
