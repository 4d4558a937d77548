"""What the tests of imported models share."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from carom.worlds import LoadedWorld, load_text
from carom.worlds.importing import Imported, Options, import_model


def imported(folder: Path, text: str, *, suffix: str = ".xml", **options: Any) -> Imported:
    """Return what becomes of the text of a model in an otherwise empty folder."""
    (folder / f"model{suffix}").write_text(text)
    return import_model(folder / f"model{suffix}", Options(**options), folder=folder, stem="world")


def world_of(folder: Path, text: str, **options: Any) -> LoadedWorld:
    """Return the world that a model becomes."""
    return load_text(imported(folder, text, **options).text, "world.yaml", folder)
