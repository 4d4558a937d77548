"""Models: the files or noise that shapes of a loaded world were made of, which a written world names as well."""

from __future__ import annotations

from pathlib import Path

from carom.ecs.errors import CaromError
from carom.systems.shapes.geometry import Geometry
from carom.worlds.builder import LoadedWorld
from carom.worlds.embedding import content_of
from carom.worlds.geometry import FILE_WORDS
from carom.worlds.writing.columns import Words


class Models:
    """The words of shapes made of noise, or of files that are still there, and which of these files were named."""

    def __init__(self, loaded: LoadedWorld | None = None) -> None:
        self.files = {} if loaded is None else loaded.files
        self.named: set[str] = set()
        self._words: dict[int, tuple[str, Words]] = {}
        for (key, _, *words), shape in ({} if loaded is None else loaded.models).items():
            stated: Words = {word: dict(value) if word == "noise" else value for word, value in words}
            if all(self._is_there(stated[word]) for word in FILE_WORDS if word in stated):
                self._words[id(getattr(shape, "geometry", None))] = key, stated

    def _is_there(self, word: str) -> bool:
        """Tell whether a file can lie beside the written world as it lies beside the one that was loaded."""
        return self.files[word].is_file() and not Path(word).is_absolute() and ".." not in Path(word).parts

    def words(self, geometry: Geometry | None) -> Words | None:
        """Return the words of a shape made of a file or of noise, None for any other."""
        key, words = self._words.get(id(geometry), ("", {}))
        self.named.update(words[word] for word in FILE_WORDS if word in words)
        return {key: words} if key else None

    def lay_beside(self, path: Path) -> None:
        """Copy the named files to where a world at ``path`` finds them; raise CaromError, having copied none.

        That is for another file in the place of one of them.
        """
        copies = {path.parent / word: content_of(self.files[word]) for word in sorted(self.named)}
        for target, content in copies.items():
            if target.exists() and content_of(target) != content:
                raise CaromError(f"{target} is another file than the one that the world names so; write elsewhere")
        for target, content in copies.items():
            if not target.exists():
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(content)
