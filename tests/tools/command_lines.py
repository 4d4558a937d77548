"""What tests of the command line share."""

from __future__ import annotations

from pathlib import Path


def changed(world: Path, before: str, after: str) -> str:
    """Return the path of the world with one thing changed."""
    text = world.read_text()
    assert before in text
    world.write_text(text.replace(before, after))
    return str(world)


def files(folder: Path) -> list[str]:
    """Return everything in a folder."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))
