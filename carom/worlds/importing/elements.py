"""XML to elements that know their line: nothing is fetched or expanded, and size, depth and count are bounded."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.sax.handler import ContentHandler
from xml.sax.xmlreader import AttributesImpl

from carom.ecs.errors import did_you_mean
from carom.worlds.errors import Fault, WorldError, shown

MOST_BYTES = 32_000_000
MOST_ELEMENTS = 200_000
DEEPEST = 128
MOST_WHOLE = 2**31 - 1


@dataclass
class Element:
    """A tag with its attributes; ``line`` and ``column`` are counted from 1 in ``file``."""

    tag: str
    attributes: dict[str, str]
    file: str
    line: int
    column: int = 1
    children: list[Element] = field(default_factory=list)

    def all(self, *tags: str) -> Iterator[Element]:
        """Yield the children of these tags, in order."""
        return (child for child in self.children if child.tag in tags)

    def one(self, tag: str) -> Element | None:
        """Return the first child of a tag."""
        return next(self.all(tag), None)


class Reading:
    """What was wrong with the words of a file, gathered so that everything is told at once."""

    def __init__(self) -> None:
        self.faults: list[Fault] = []

    def fault(self, element: Element, what: str, *, received: str = "", accepted: str = "", hint: str = "") -> None:
        """Note what is wrong at an element."""
        place = f"<{element.tag}>"
        self.faults.append(Fault(element.file, element.line, element.column, place, what, received, accepted, hint))

    def refuse_if_faulty(self) -> None:
        """Raise WorldError with all faults."""
        if self.faults:
            raise WorldError(self.faults)

    def text(self, element: Element, key: str) -> str:
        """Return an attribute that must be there."""
        if key not in element.attributes:
            self.fault(element, f"has no {key}", accepted=f'{key}="..."')
        return element.attributes.get(key, "")

    def choice(self, element: Element, key: str, choices: tuple[str, ...], default: str | None = None) -> str:
        """Return an attribute that is one of some words."""
        found = element.attributes.get(key, default)
        if found is None or found not in choices:
            hint = did_you_mean(found or "", choices)
            self.fault(element, f"unknown {key}", received=shown(found), accepted=", ".join(choices), hint=hint)
            return default or choices[0]
        return found

    def number(self, element: Element, key: str, default: float | None = None, *, least: float = -math.inf) -> float:
        """Return an attribute that is a finite number, no less than ``least``."""
        (found,) = self.numbers(element, key, 1, None if default is None else (default,))
        if found < least:
            self.fault(element, f"{key} must be at least {least:g}", received=f"{found:g}")
        return found

    def whole(self, element: Element, key: str, default: int) -> int:
        """Return an attribute that is a whole number of 31 bits."""
        stated = element.attributes.get(key, str(default)).strip()
        if not stated.isdecimal() or int(stated) > MOST_WHOLE:
            self.fault(element, f"{key} is no whole number", received=shown(stated), accepted=f"0 to {MOST_WHOLE}")
            return default
        return int(stated)

    def numbers(
        self, element: Element, key: str, count: int, default: Any = None, *, fewer: bool = False
    ) -> tuple[float, ...]:
        """Return an attribute of so many finite numbers, or of fewer where that is allowed."""
        if key not in element.attributes:
            if default is None:
                self.fault(element, f"has no {key}", accepted=f"{count} number{'s' * (count > 1)}")
            return tuple(default) if default is not None else (0.0,) * count
        words = element.attributes[key].split()
        try:
            found = tuple(float(word) for word in words)
        except ValueError:
            found = ()
        right = len(found) == len(words) and (0 < len(found) <= count if fewer else len(found) == count)
        if not right or not all(map(math.isfinite, found)):
            accepted = f"{'up to ' * fewer}{count} finite number{'s' * (count > 1)}"
            self.fault(element, f"{key} is not right", received=shown(element.attributes[key]), accepted=accepted)
            return tuple(default) if default is not None else (0.0,) * count
        return found


class _Handler(ContentHandler):
    """Builds the elements of a text."""

    def __init__(self, file: str) -> None:
        super().__init__()
        self.file, self.count = file, 0
        self.root: Element | None = None
        self.open: list[Element] = []

    def startElement(self, name: str, attrs: AttributesImpl) -> None:  # noqa: N802 - SAX's own name
        line = int(self._locator.getLineNumber())  # type: ignore[attr-defined]
        column = int(self._locator.getColumnNumber()) + 1  # type: ignore[attr-defined]
        element = Element(name, dict(attrs.items()), self.file, line, column)
        self.count += 1
        if self.count > MOST_ELEMENTS:
            raise WorldError([Fault(self.file, line, column, "", f"holds more than {MOST_ELEMENTS:,} elements")])
        if len(self.open) >= DEEPEST:
            raise WorldError([Fault(self.file, line, column, "", f"is nested deeper than {DEEPEST} levels")])
        if self.open:
            self.open[-1].children.append(element)
        else:
            self.root = element
        self.open.append(element)

    def endElement(self, name: str) -> None:  # noqa: N802 - SAX's own name
        self.open.pop()


def read_xml(path: Path, name: str) -> Element:
    """Return the root element of a file, called ``name`` in messages.

    Raises WorldError for what is no XML, declares entities, or is beyond the bounds.
    """
    from xml.sax import SAXParseException

    from defusedxml.common import DefusedXmlException
    from defusedxml.sax import parse

    if not path.is_file():
        raise WorldError([Fault(name, 0, 0, "", "does not exist")])
    if path.stat().st_size > MOST_BYTES:
        raise WorldError([Fault(name, 0, 0, "", f"is larger than a model may be, {MOST_BYTES} bytes")])
    handler = _Handler(name)
    try:
        parse(str(path), handler)
    except DefusedXmlException as fault:
        accepted = "XML without entities, which could unfold without end or fetch files"
        raise WorldError([Fault(name, 1, 1, "", "declares entities", type(fault).__name__, accepted)]) from None
    except SAXParseException as fault:
        place = (fault.getLineNumber() or 1, (fault.getColumnNumber() or 0) + 1)
        raise WorldError([Fault(name, *place, "", f"is not XML: {fault.getMessage()}")]) from None
    except (ValueError, LookupError) as fault:  # an encoding that nobody knows
        raise WorldError([Fault(name, 1, 1, "", f"is not XML: {fault}")]) from None
    assert handler.root is not None
    return handler.root
