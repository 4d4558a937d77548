"""Includes: what other files beside a world say, put together with what it says itself."""

from __future__ import annotations

import posixpath
from pathlib import PurePath
from typing import Any

from carom.worlds import library
from carom.worlds.check import check_section, collection, refuse_form
from carom.worlds.errors import Path, WorldError
from carom.worlds.files import WorldFiles, joined
from carom.worlds.header import with_header
from carom.worlds.reader import MOST_CHARACTERS, read
from carom.worlds.schema import document
from carom.worlds.source import Source

MOST_FILES = 100
DEEPEST = 16  # files that include each other in a row
ITS_OWN = ("carom", "include", "name", "description")  # what a file says of itself alone


class Includes:
    """Takes the files a world includes, each once."""

    def __init__(self, world: Source, files: WorldFiles) -> None:
        self.world, self.files = world, files
        self.taken: set[str] = set()
        self.characters = len(world.text)

    def take(self, source: Source, chain: tuple[str, ...]) -> None:
        """Put what a file includes under its own words; report what cannot be included.

        Mappings are joined name by name, lists one after another, other sections are those of one file. A file goes
        before those it includes; two that stand side by side may not say the same thing twice.
        """
        words = source.data.get("include", [])
        included = check_section(source, "include", words)
        parts = [self._read(source, ("include", index), word, chain) for index, word in enumerate(included) if word]
        if any(part is not None for part in parts):
            _Merge(source).under([part for part in parts if part is not None])

    def _read(self, source: Source, path: Path, word: str, chain: tuple[str, ...]) -> Source | None:
        """Return an included file with all that it includes itself; None where it was taken before or reported."""
        name = joined(source.folder, posixpath.normpath(word))
        fault = self._refusal(name, word, chain)
        if fault:
            source.report(path, fault, received=repr(word))
            return None
        if name in self.taken:
            return None
        self.taken.add(name)
        shown = str(PurePath(self.world.name).parent / name)
        try:
            part = read(library.read_text(self.files.find(name), shown), shown)
            part.folder = posixpath.dirname(name)
            self.world.faults += part.faults
            part.faults = self.world.faults  # from here on they are told together
            self.characters += len(part.text)
            with_header(part)
        except WorldError as fault_of_file:
            self.world.faults += fault_of_file.faults
            return None
        self.take(part, (*chain, name))
        return part

    def _refusal(self, name: str, word: str, chain: tuple[str, ...]) -> str:
        """Return why a file cannot be included, empty where it can."""
        if name in chain:
            return f"includes itself: {' -> '.join((*chain, name))}"
        if posixpath.splitext(name)[1] not in library.SUFFIXES:
            return f"is no world file; its name ends in {', '.join(library.SUFFIXES)}"
        if not self.files.within(name):
            return "lies outside the folder of the world; move it there"
        if name not in self.taken and len(self.taken) == MOST_FILES:
            return f"is one file more than a world may include, {MOST_FILES}"
        if len(chain) > DEEPEST:
            return f"is included through more than {DEEPEST} files"
        if self.characters > MOST_CHARACTERS:
            return f"is too much: all files together may have {MOST_CHARACTERS} characters"
        if not self.files.find(name).is_file():
            return f"file {self.files.find(name)} does not exist"
        return ""


class _Merge:
    """Puts the data of files together, noting which file each part is of."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.own = source.data
        self.parts: dict[Path, tuple[Source, Path]] = {}
        self.data: dict[str, Any] = {}

    def under(self, included: list[Source]) -> None:
        """Lay the file's own words over those of the files it includes."""
        for part in included:
            self.source.computes = self.source.computes or part.computes
            for key, value in part.data.items():
                if key not in ITS_OWN:
                    self._add(part, key, value, beside=True)
        for key, value in self.own.items():
            self._add(self.source, key, value, beside=False)
        self.source.data, self.source.parts = self.data, self.parts

    def _add(self, part: Source, key: str, value: Any, *, beside: bool) -> None:
        kind = collection(key) if key in document().model_fields else None
        home = part.home((key,))
        if kind is None:
            if beside and key in self.data:
                self._twice(part, (key,))
            self.data[key], self.parts[key,] = value, home
        elif not isinstance(value, kind):
            refuse_form(part, (key,), value, kind)
        elif kind is list:
            items = self.data.setdefault(key, [])
            for index in range(len(value)):
                self.parts[key, len(items) + index] = part.home((key, index))
            items += value
            self.parts[key,] = home
        else:
            items = self.data.setdefault(key, {})
            for name in value:
                if beside and name in items:
                    self._twice(part, (key, name))
                self.parts[key, name] = part.home((key, name))
            items |= value
            self.parts[key,] = home

    def _twice(self, part: Source, path: Path) -> None:
        first, there = self.parts[path]
        if first is part:
            return
        line = first.positions[there][0]
        part.report(
            path, f"is said by {first.name} as well, at line {line}", hint="say it in the file that includes both"
        )
