"""Outputs: whether the files a command is to write can be written, found out before anything runs."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable
from pathlib import Path

from carom.ecs.errors import CaromError


def prepare_outputs(paths: Iterable[Path | None]) -> None:
    """Make the folders of the files to be written; raise CaromError, having made none, when one cannot be written."""
    wanted = [path for path in paths if path is not None]
    faults = [fault for path in wanted if (fault := _fault(path))]
    if faults:
        raise CaromError("\n".join(faults))
    for path in wanted:
        path.parent.mkdir(parents=True, exist_ok=True)


def _fault(path: Path) -> str | None:
    if path.is_dir():
        return f"cannot write {path}: it is a folder; name a file in it"
    folder = path.parent
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    try:
        with tempfile.TemporaryFile(dir=folder):
            return None
    except OSError as fault:
        return f"cannot write {path}: {folder}: {fault.strerror}; choose a folder that can be written"
