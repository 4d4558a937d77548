"""Faults of world files: each says where, what, what was received and what is accepted."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any

from carom.ecs.errors import CaromError

Path = tuple[str | int, ...]

LONGEST_PART = 300  # characters of each part of a message that a file can fill with its own words
LONGEST_LIST = 1500  # of what is accepted


def dotted(path: Path) -> str:
    """Return a path as messages show it, ``entities.3.body``; a key of blanks alone stands in quotes."""
    return ".".join(str(step) if str(step).strip() else repr(step) for step in path)


class WordError(ValueError):
    """A value that cannot be read, before it is known where it stands."""

    def __init__(self, what: str, *, received: str = "", accepted: str = "", hint: str = "", name: str = "") -> None:
        super().__init__(what)
        self.what, self.received, self.accepted, self.hint = what, received, accepted, hint
        self.name = name  # the name that nothing defines, where that is the fault

    def line(self, place: str) -> str:
        """Return the line that tells it of ``place``, an option or a file, where no line and column are known."""
        return str(Fault(place, 0, 0, "", self.what, self.received, self.accepted, self.hint))


class ReportedError(Exception):
    """What was wrong is reported already."""


@dataclass(frozen=True, order=True)
class Fault:
    """One thing wrong in a file, at a line and column counted from 1 (0: the file as a whole)."""

    file: str
    line: int
    column: int
    path: str
    what: str
    received: str = ""
    accepted: str = ""
    hint: str = ""

    def __str__(self) -> str:
        """Return ``file:line:column: path: what; received; accepted``, without the parts that are not there."""
        place = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        parts = [_short(self.what)]
        parts += [f"received {_short(self.received)}"] if self.received else []
        parts += [f"accepted: {_short(self.accepted, LONGEST_LIST)}"] if self.accepted else []
        parts += [self.hint] if self.hint else []
        return _visible(": ".join(part for part in (place, _short(self.path), "; ".join(parts)) if part))


class WorldError(CaromError):
    """A world file that cannot be used; ``faults`` holds everything wrong in it, in order of position.

    ``files`` are those that it names, as far as it could be read.
    """

    def __init__(self, faults: Iterable[Fault]) -> None:
        self.faults = sorted(set(faults))
        self.files: list[FilePath] = []
        super().__init__("\n".join(map(str, self.faults)))


def _visible(text: str) -> str:
    """Return a line with escapes for characters that a terminal would obey or not show."""
    return text if text.isprintable() else "".join(map(_escaped, text))


def _escaped(character: str) -> str:
    return character if character.isprintable() else character.encode("unicode_escape").decode()


def _short(text: str, most: int = LONGEST_PART) -> str:
    return text if len(text) <= most else text[: most - 3] + "..."


def shown(value: Any) -> str:
    """Return a value as a message shows it: short, in the words of a file."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return f"a mapping of {', '.join(map(str, value)) or 'nothing'}"
    if isinstance(value, list) and any(isinstance(item, (dict, list)) for item in value):
        return f"a list of {len(value)}"
    if isinstance(value, list):
        return f"[{', '.join(map(shown, value))}]"
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
