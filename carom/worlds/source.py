"""What a world file says, with what it includes, and where each word of it stands."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from carom.ecs.errors import CaromError
from carom.systems.parameters import WordFault
from carom.worlds.errors import Fault, Path, WordError, WorldError, dotted

OPENING = "${"  # of an expression

PART = re.compile(r"[.\[]")  # begins what follows the name of a group, or of what copies are made of

Position = tuple[int, int]


@dataclass
class Source:
    """What a file says: plain data, where each path of it stands (line and column from 1), and what is wrong.

    Once its includes are taken, ``data`` is that of all files together and ``parts`` says which file each item is of.
    """

    name: str
    text: str
    folder: str = ""  # from that of the world's own file
    data: Any = None
    positions: dict[Path, Position] = field(default_factory=dict)
    parts: dict[Path, tuple[Source, Path]] = field(default_factory=dict)  # sections and items that others wrote
    faults: list[Fault] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    excused: set[str] = field(default_factory=set)  # names of entities that were reported and so do not exist
    inherits: dict[Path, Path] = field(default_factory=dict)  # an entity, prefab or member to the prefab it extends
    computes: bool = False  # whether a text of it has an expression
    unusable: set[Path] = field(default_factory=set)  # where an expression was reported, so that nothing else is there

    def report(self, path: Path, what: str, *, received: str = "", accepted: str = "", hint: str = "") -> None:
        """Note a fault at the nearest part of ``path`` that the file has, or that a prefab has for it."""
        found = self.locate(path)
        if any(found[: len(there)] == there[: len(found)] for there in self.unusable):
            return
        missing = path[len(path) - self._missing(path) :]
        self.faults.append(self._fault(found, missing, what, received, accepted, hint))

    def warn(self, path: Path, what: str) -> None:
        """Note what a user should know although the file can be used."""
        found = self.locate(path)
        self.warnings.append(str(self._fault(found, path[len(found) :], what)))

    def report_value(self, path: Path, fault: WordError | WordFault) -> None:
        """Note a value that could not be read, unless it only names what was itself reported."""
        ends = [match.start() for match in PART.finditer(fault.name)]
        if not any(fault.name[:end] in self.excused for end in (*ends, len(fault.name))):
            self.report(path, fault.what, received=fault.received, accepted=fault.accepted, hint=fault.hint)

    @contextmanager
    def telling(self, path: Path) -> Iterator[None]:
        """Report what carom refuses of what stands at ``path``, unless that may follow from what was reported."""
        try:
            yield
        except CaromError as fault:
            if not self.faults:
                self.report(path, str(fault))

    def written(self, path: Path) -> bool:
        """Tell whether the whole path is in the file, be it by a prefab."""
        return bool(path) and self._missing(path) == 0

    def locate(self, path: Path) -> Path:
        """Return where the nearest part of ``path`` is written: itself, or the same words in its prefab."""
        found = (self._found(path[:end]) for end in range(len(path), 0, -1))
        return next((place for place in found if place is not None), ())

    def _found(self, path: Path) -> Path | None:
        """Return where a whole path is written, None where it is nowhere."""
        candidate: Path | None = path
        while candidate is not None:
            home, own = self.home(candidate)
            if own in home.positions:
                return candidate
            length = next((n for n in range(len(candidate), 1, -1) if candidate[:n] in self.inherits), 0)
            candidate = (*self.inherits[candidate[:length]], *candidate[length:]) if length else None
        return None

    def home(self, path: Path) -> tuple[Source, Path]:
        """Return the file that a path is of, and the path in it."""
        for length in (2, 1):
            if len(path) >= length and path[:length] in self.parts:
                home, own = self.parts[path[:length]]
                return home, (*own, *path[length:])
        return self, path

    def _missing(self, path: Path) -> int:
        """Return how many words at the end of ``path`` are written nowhere."""
        return next((n for n in range(len(path)) if self._found(path[: len(path) - n]) is not None), len(path))

    def position(self, path: Path) -> Position:
        """Return line and column of the nearest part of ``path`` that is written."""
        home, own = self.home(self.locate(path))
        return home.positions.get(own, (1, 1))

    def written_at(self, path: Path) -> str:
        """Return file, line and column of the nearest part of ``path`` that is written, such as ``world.yaml:8:5``."""
        line, column = self.position(path)
        return f"{self.home(self.locate(path))[0].name}:{line}:{column}"

    def place(self, path: Path) -> str:
        """Return the words for another place, such as ``entities.0 at line 8``."""
        home, own = self.home(path)
        file = "" if home is self else f" of {home.name}"
        return f"{dotted(own)} at line {self.position(path)[0]}{file}"

    def _fault(self, found: Path, missing: Path, *told: str) -> Fault:
        home, own = self.home(found)
        line, column = home.positions.get(own, (1, 1))
        return Fault(home.name, line, column, dotted((*own, *missing)), *told)

    def refuse_if_faulty(self) -> None:
        """Raise WorldError when anything was reported."""
        if self.faults:
            raise WorldError(self.faults)
