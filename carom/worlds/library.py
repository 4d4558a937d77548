"""The worlds that come with carom."""

from __future__ import annotations

from importlib.resources import files
from itertools import dropwhile, takewhile
from pathlib import Path

from carom.ecs.errors import did_you_mean
from carom.worlds.errors import Fault, WorldError
from carom.worlds.reader import MOST_CHARACTERS

MOST_BYTES = 4 * MOST_CHARACTERS  # UTF-8 takes at most four for each
SUFFIXES = (".yaml", ".yml", ".json")


def names() -> list[str]:
    """Return the names of the library's worlds, sorted."""
    return sorted(_paths())


def groups() -> dict[str, list[str]]:
    """Return the names of the library's worlds by group, which is the folder that a world lies in, all sorted."""
    found: dict[str, list[str]] = {}
    for name, path in sorted(_paths().items()):
        found.setdefault(path.parent.name, []).append(name)
    return dict(sorted(found.items()))


def lesson(text: str) -> str:
    """Return the comment that a world file begins with, line by line, without its marks.

    That is the first run of lines that are comments from their first column on.
    """
    lines = dropwhile(lambda line: not line.startswith("#"), text.splitlines())
    comment = takewhile(lambda line: line.startswith("#"), lines)
    return "\n".join(line.removeprefix("#").removeprefix(" ").rstrip() for line in comment)


def _paths() -> dict[str, Path]:
    folder = Path(str(files("carom.worlds").joinpath("library")))
    return {path.stem: path for path in folder.rglob("*.yaml")}


def find(world: str | Path) -> Path:
    """Return the file of a world given by path or by library name; raise WorldError when there is none."""
    path, text = Path(world), str(world)
    if path.is_file():
        return path
    if text in (known := _paths()):
        return known[text]
    accepted, what = "a world file, or the name of a library world", "does not exist"
    beside = [str(path.with_name(file.name)) for file in sorted(path.parent.glob("*")) if file.suffix in SUFFIXES]
    near = [*names(), *beside]
    if path.is_dir():
        what, near = "is a folder", []
    elif path.suffix not in SUFFIXES and len(path.parts) == 1:
        what, accepted = "no world of this name", ", ".join(names())
        near = [name for name in beside if Path(name).stem == text] or near
    raise WorldError([Fault(text, 0, 0, "", what, accepted=accepted, hint=did_you_mean(text, near))])


def read_text(path: Path, shown: str) -> str:
    """Return the text of a world file; raise WorldError when it cannot be read or is not UTF-8."""
    try:
        if path.stat().st_size > MOST_BYTES:
            raise WorldError([Fault(shown, 0, 0, "", f"is larger than a world file may be, {MOST_BYTES:,} bytes")])
        return path.read_bytes().decode("utf-8-sig")
    except OSError as fault:
        what = f"cannot be read: {(fault.strerror or str(fault)).lower()}"
    except UnicodeDecodeError as fault:
        what = f"is not text in UTF-8: byte {fault.start} is {fault.object[fault.start]:#04x}"
    raise WorldError([Fault(shown, 0, 0, "", what)])
