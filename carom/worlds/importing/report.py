"""What became of a model: counts of what was kept, and a note on all that was approximated or dropped."""

from __future__ import annotations

from collections import Counter
from typing import Any, NamedTuple

from carom.worlds.importing.elements import Element

APPROXIMATED, DROPPED = "approximated", "dropped"
LISTED = 4  # names that a line lists


class Note(NamedTuple):
    """Something that did not come over as it was: what, of whom, and where the file says it (line 0: as a whole)."""

    fate: str
    what: str
    whose: str
    file: str
    line: int

    @property
    def place(self) -> str:
        """Return file and line."""
        return f"{self.file}:{self.line}" if self.line else self.file


class Report:
    """What was kept, approximated and dropped."""

    def __init__(self) -> None:
        self.kept: Counter[str] = Counter()
        self.notes: list[Note] = []

    def keep(self, what: str, count: int = 1) -> None:
        """Count something that came over as it was."""
        self.kept[what] += count

    def approximate(self, element: Element, what: str, whose: str = "") -> None:
        """Note what came over in another form."""
        self.notes.append(Note(APPROXIMATED, what, whose, element.file, element.line))

    def drop(self, element: Element, what: str, whose: str = "") -> None:
        """Note what did not come over."""
        self.notes.append(Note(DROPPED, what, whose, element.file, element.line))

    @property
    def exact(self) -> bool:
        """Tell whether everything was kept."""
        return not self.notes

    def lines(self) -> list[str]:
        """Return lines for the user: what was kept, then notes of one kind together, in the order of the file."""
        kept = ", ".join(f"{count} {what if count == 1 else plural(what)}" for what, count in self.kept.items())
        lines = [f"kept          {kept or 'nothing'}"]
        together: dict[tuple[str, str], list[Note]] = {}
        for note in self.notes:
            together.setdefault((note.fate, note.what), []).append(note)
        for (fate, what), notes in sorted(together.items(), key=lambda item: item[0][0]):
            names = list(dict.fromkeys(note.whose for note in notes if note.whose))
            listed = ", ".join(names[:LISTED]) + (f" and {len(names) - LISTED} more" if len(names) > LISTED else "")
            whose = f": {listed}" if listed else f" ({len(notes)})" if len(notes) > 1 else ""
            lines.append(f"{fate:<12}  {what}{whose}; {notes[0].place}")
        return lines

    def as_data(self) -> dict[str, Any]:
        """Return all of it as plain data, each note by itself."""
        told = [{"what": n.what, "whose": n.whose, "file": n.file, "line": n.line, "fate": n.fate} for n in self.notes]
        return {
            "kept": dict(self.kept),
            **{
                fate: [_without_fate(note) for note in told if note["fate"] == fate] for fate in (APPROXIMATED, DROPPED)
            },
        }


def plural(noun: str) -> str:
    """Return the plural of a noun of the report."""
    return noun[:-1] + "ies" if noun.endswith("y") else noun + "s"


def _without_fate(note: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in note.items() if key != "fate"}
