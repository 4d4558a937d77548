"""Files that a world names: each is found once, beside the world or where it is said to be."""

from __future__ import annotations

import posixpath
from collections.abc import Mapping
from pathlib import Path


class WorldFiles:
    """Files by the words of a world for them: where ``given`` says, or in the folder of the world."""

    def __init__(self, folder: Path, given: Mapping[str, Path]) -> None:
        self.folder, self.given = folder, given
        self.used: dict[str, Path] = {}

    def find(self, word: str) -> Path:
        """Return the path of a file, which need not exist, and note that the world uses it."""
        self.used[word] = self.given.get(word, self.folder / word)
        return self.used[word]

    def within(self, word: str) -> bool:
        """Tell whether a file lies in the folder of the world, or in one below, links followed."""
        if word.startswith("/") or word.split("/")[0] == "..":
            return False
        return word in self.given or (self.folder / word).resolve().is_relative_to(self.folder.resolve())


def joined(folder: str, word: str) -> str:
    """Return the word of the world for a file that a file in one of its folders calls ``word``."""
    return posixpath.normpath(posixpath.join(folder, word)) if folder else word
