"""The tree of a text: what the file says, as it is written, with the comments at what they stand above or beside.

Our own, on the events of the parser that reads worlds: ruamel.yaml hangs a comment on what stands before it, so that it
stays behind when a section moves, and breaks vectors where its lines are full.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from carom.worlds.errors import Path


@dataclass
class Scalar:
    """A value as written; ``value`` is its text without quotes, ``block`` the lines of one after ``|`` or ``>``."""

    text: str
    value: str
    plain: bool = False
    block: list[str] = field(default_factory=list)


@dataclass
class Collection:
    """A mapping or a list; ``flow`` as in braces, ``tail`` the comments after its last entry."""

    kind: type[Any]
    flow: bool
    anchor: str = ""
    entries: list[Entry] = field(default_factory=list)
    tail: list[str] = field(default_factory=list)

    def entry(self, path: Path) -> Entry:
        """Return the entry at a path; raise KeyError where there is none."""
        step, *rest = path
        for index, entry in enumerate(self.entries):
            if step == (index if entry.key is None else entry.key.value):
                if not rest:
                    return entry
                if isinstance(entry.node, Collection):
                    return entry.node.entry(tuple(rest))
        raise KeyError(path)

    def remove(self, entry: Entry) -> None:
        """Take an entry out; its comments stay, above what follows."""
        index = next(index for index, other in enumerate(self.entries) if other is entry)
        del self.entries[index]
        left = [*entry.above, *entry.beside]
        if index < len(self.entries):
            self.entries[index].above[:0] = left
        else:
            self.tail[:0] = left


Node = Scalar | Collection


@dataclass
class Entry:
    """An item of a list, or a key with its value, with the comments above (an empty one is a blank line) and beside.

    ``place`` is its line and column, from 1.
    """

    key: Scalar | None
    node: Node
    above: list[str]
    place: tuple[int, int]
    beside: list[str] = field(default_factory=list)

    def taken(self) -> list[str]:
        """Return and forget the comments above."""
        above, self.above = self.above, []
        return above
