"""Variables of world files: values by name, and every ``${expression}`` that is made of them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from carom.worlds.errors import Path, ReportedError, WordError, dotted, shown
from carom.worlds.expression import evaluate
from carom.worlds.names import known
from carom.worlds.quantity import Quantity, in_words
from carom.worlds.source import OPENING, Source
from carom.worlds.units import read_any

EXPRESSION = re.compile(r"\$\{([^{}]*)\}")
NAME = re.compile(r"[^\W\d]\w*")
COMPONENTS = "xyzw"
LONGEST_LIST = 64
MOST_STEPS = 64  # from a variable to those it is made of
LONGEST_TEXT = 1000  # texts of texts of texts would fill the memory


class Variables:
    """Values by name, each settled when it is first asked for; ``outer`` has the names that these have not."""

    def __init__(self, source: Source, path: Path, stated: Any, outer: Variables | None = None) -> None:
        self.source, self.path, self.outer = source, path, outer
        self.stated: Mapping[str, Any] = stated if isinstance(stated, Mapping) else {}
        self.settled: dict[Path, Any] = {}
        self.settling: list[Path] = []

    def settle_all(self) -> None:
        """Report everything that is wrong with them, be it asked for or not."""
        self._settle_under((), self.stated)

    def _settle_under(self, steps: Path, stated: Mapping[str, Any]) -> None:
        for name, value in stated.items():
            if not NAME.fullmatch(name):
                accepted = "a letter or _, then letters, digits or _"
                self.source.report((*self.path, *steps, name), "is not the name of a variable", accepted=accepted)
            elif isinstance(value, Mapping):
                self._settle_under((*steps, name), value)
            else:
                try:
                    self._settle((*steps, name), value)
                except ReportedError:
                    continue

    def look_up(self, name: str) -> Any:
        """Return the value of ``table.length``; raise WordError for a name that nothing defines."""
        first, *rest = name.split(".")
        if first not in self.stated and self.outer is not None:
            return self.outer.look_up(name)
        value: Any = self.stated
        steps: list[str] = []
        for step in (first, *rest):
            if not isinstance(value, Mapping):
                return _component(name, self._settle(tuple(steps), value), [first, *rest][len(steps) :])
            known("variable", step, value)
            value = value[step]
            steps.append(step)
        if isinstance(value, Mapping):
            raise WordError(f"{name} is several variables", accepted=", ".join(f"{name}.{key}" for key in value))
        return self._settle(tuple(steps), value)

    def fill(self, value: Any, path: Path) -> Any:
        """Return data with every ``${expression}`` replaced; what cannot be is reported there and becomes None."""
        if isinstance(value, str):
            return self._text(value, path) if OPENING in value else value
        if isinstance(value, dict):
            return {key: self.fill(item, (*path, key)) for key, item in value.items()}
        if isinstance(value, list):
            return [self.fill(item, (*path, index)) for index, item in enumerate(value)]
        return value

    def _text(self, text: str, path: Path) -> Any:
        try:
            return self._filled(text)
        except WordError as fault:
            self.source.report_value(path, fault)
        except ReportedError:
            pass
        self.source.unusable.add(self.source.locate(path))
        return None

    def _filled(self, text: str) -> Any:
        whole = EXPRESSION.fullmatch(text.strip())
        if whole is not None:
            return evaluate(whole[1].strip(), self.look_up)
        filled = EXPRESSION.sub(lambda found: _in_text(evaluate(found[1].strip(), self.look_up)), text)
        if OPENING in EXPRESSION.sub("", text):
            raise WordError("has an expression that does not end", received=shown(text), accepted="${...}")
        if len(filled) > LONGEST_TEXT:
            raise WordError(f"becomes longer than {LONGEST_TEXT} characters", received=shown(text))
        return filled

    def _settle(self, steps: Path, value: Any) -> Any:
        if steps in self.settling:
            circle = " -> ".join(dotted(item) for item in (*self.settling, steps))
            raise WordError(f"is made of itself: {circle}")
        if len(self.settling) == MOST_STEPS:
            raise WordError(f"is made of more than {MOST_STEPS} variables, one of another")
        if steps not in self.settled:
            self.settling.append(steps)
            try:
                self.settled[steps] = self._read(value)
            except WordError as fault:
                self.source.report((*self.path, *steps), fault.what, **_told(fault))
                self.settled[steps] = ReportedError
            except ReportedError:
                self.settled[steps] = ReportedError
            finally:
                self.settling.pop()
        if self.settled[steps] is ReportedError:
            raise ReportedError
        return self.settled[steps]

    def _read(self, value: Any) -> Any:
        if isinstance(value, list):
            if len(value) > LONGEST_LIST or any(isinstance(item, (list, dict)) for item in value):
                accepted = f"at most {LONGEST_LIST} numbers, texts or expressions"
                raise WordError("is no list for a variable", received=shown(value), accepted=accepted)
            return [self._read(item) for item in value]
        if value is None:
            raise WordError("has no value", accepted="a number, one with a unit, a text, a list, true or false")
        if not isinstance(value, str):
            return value
        filled = self._filled(value) if OPENING in value else value
        number = read_any(filled) if isinstance(filled, str) else None
        return filled if number is None else number


def _component(name: str, value: Any, steps: list[str]) -> Any:
    """Return a component of a list: ``size.x``."""
    (step, *beyond) = steps
    parts = COMPONENTS[: len(value)] if isinstance(value, list) else ""
    if beyond or len(step) > 1 or step not in parts:
        what = f"{name.removesuffix('.' + '.'.join(steps))} has no {'.'.join(steps)}"
        raise WordError(what, accepted=", ".join(parts) or "its name alone")
    return value[parts.index(step)]


def _in_text(value: Any) -> str:
    """Return a value as part of a text."""
    if isinstance(value, list):
        raise WordError("puts a list into a text", received=shown(value))
    if isinstance(value, bool):
        return shown(value)
    return in_words(value) if isinstance(value, (int, float)) and not isinstance(value, Quantity) else str(value)


def _told(fault: WordError) -> dict[str, str]:
    return {"received": fault.received, "accepted": fault.accepted, "hint": fault.hint}
