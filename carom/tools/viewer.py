"""Viewer: Rerun's own program, which comes with its package."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

from carom.ecs.errors import CaromError


def viewer_binary() -> Path:
    """Return the viewer itself: the ``rerun`` script starts it as a child, which outlives a signal to the script."""
    package = find_spec("rerun_cli")
    for folder in package.submodule_search_locations or () if package else ():
        for name in ("rerun", "rerun.exe"):
            if (Path(folder) / name).is_file():
                return Path(folder) / name
    raise CaromError("the Rerun viewer is missing from this installation; run: pip install --force-reinstall rerun-sdk")
