"""Files that a model names: found below its root folder, or told why not."""

from __future__ import annotations

from pathlib import Path

from carom.worlds.errors import shown
from carom.worlds.importing.elements import Element, Reading
from carom.worlds.importing.report import Report

PACKAGE, FILE = "package://", "file://"


class ModelFiles:
    """Files below ``root``, named from the model's own folder."""

    def __init__(self, folder: Path, root: Path, endings: tuple[str, ...], reading: Reading, report: Report) -> None:
        self.folder, self.root, self.endings = folder, root.resolve(), endings
        self.reading, self.report = reading, report

    def find(self, element: Element, word: str, whose: str, *, folder: str = "") -> Path | None:
        """Return the path of a file; one outside the root is a fault, one that is missing or unknown is dropped.

        Of ``package://name/rest`` the folder ``name`` is the root itself or below it, or ``rest`` is.
        """
        try:
            found = self._place(word, folder)
        except (OSError, ValueError):  # a name that no file can have
            found = None
        if found is None:
            self.report.drop(element, f"the file {shown(word)}, which is not there", whose)
            return None
        if not found.is_relative_to(self.root):
            accepted = f"files below {self.root}; --root names another folder"
            self.reading.fault(element, "names a file outside the root", received=shown(word), accepted=accepted)
            return None
        if not found.is_file():
            self.report.drop(element, f"the file {shown(word)}, which is not there", whose)
            return None
        if found.suffix.lower() not in self.endings:
            self.report.drop(element, f"{found.suffix.lower() or 'nameless'} files", whose)
            return None
        return found

    def _place(self, word: str, folder: str) -> Path | None:
        if not word.startswith(PACKAGE):
            return (self.folder / folder / word.removeprefix(FILE)).resolve()
        package, _, rest = word.removeprefix(PACKAGE).partition("/")
        above = [place / rest for place in (self.root, *self.root.parents[:1]) if place.name == package]
        for place in (*above, self.root / package / rest, self.root / rest):
            if place.exists():
                return place.resolve()
        return None
