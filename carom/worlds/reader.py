"""Text of a world file to plain data, with the position of every value: YAML by the rules of version 1.2."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import Any

import yaml

from carom.worlds.errors import Fault, Path, WorldError, dotted, shown
from carom.worlds.no_yaml import DEEPEST, TOO_DEEP, no_yaml
from carom.worlds.source import OPENING, Position, Source

MOST_CHARACTERS = 32_000_000  # a file of a million bodies; above it is no world
MOST_REPEATED = 200_000  # values that come from aliases: a "billion laughs" file is short and unfolds without end


class Loader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # type: ignore[misc]
    """PyYAML's parser (in C where libyaml is present) with the words of YAML 1.2: ``on`` and ``NO`` are text."""

    yaml_implicit_resolvers: dict[str, Any] = {}  # noqa: RUF012 - PyYAML's own name and form


for _tag, _pattern, _first in (
    ("bool", r"true|True|TRUE|false|False|FALSE", "tTfF"),
    ("null", r"null|Null|NULL|~|", "nN~"),
    ("int", r"[-+]?(?:0|[1-9][0-9]*)", "-+0123456789"),
    ("float", r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?", "-+.0123456789"),
    ("float", r"[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)", "-+."),
):
    _firsts = [*_first, ""] if _tag == "null" else list(_first)
    Loader.add_implicit_resolver("tag:yaml.org,2002:" + _tag, re.compile(rf"(?:{_pattern})\Z"), _firsts)


def read(text: str, name: str) -> Source:
    """Return the data of a text; raise WorldError when it is not YAML.

    Duplicate keys and tags are noted as faults and left out, so that the rest can be checked in the same run. NaN and
    infinity are read as such, for the schema to refuse.
    """
    source = Source(name, text)
    if len(text) > MOST_CHARACTERS:
        raise WorldError([Fault(name, 0, 0, "", f"is larger than a world file may be, {MOST_CHARACTERS} characters")])
    try:
        source.data = _Builder(source).document()
    except yaml.YAMLError as fault:
        raise WorldError([no_yaml(name, text, fault)]) from None
    return source


class _Builder:
    """Turns events into data, counting what it makes.

    Events, not PyYAML's nodes: its C composer overflows the stack on a file of brackets and takes the process with it.
    """

    def __init__(self, source: Source) -> None:
        self.source, self.repeated = source, 0
        self.loader = Loader(source.text)
        self.events: Iterator[Any] = iter(self.loader.get_event, None)
        self.anchored: dict[str, list[Any]] = {}
        self.recorders: list[list[Any]] = []
        self.repeating = False

    def document(self) -> Any:
        next(self.events)  # the start of the stream
        if isinstance(next(self.events), yaml.StreamEndEvent):
            return None
        data = self.build(self.next(), ())
        next(self.events)  # the end of the document
        beyond = next(self.events)
        if not isinstance(beyond, yaml.StreamEndEvent):
            raise self.refusal(beyond, "holds more than one document")
        return data

    def next(self) -> Any:
        event = next(self.events)
        for recorder in self.recorders:
            recorder.append(event)
        return event

    def build(self, event: Any, path: Path) -> Any:
        self.repeated += self.repeating
        if self.repeated > MOST_REPEATED:
            raise self.refusal(event, f"repeats more than {MOST_REPEATED} values by aliases")
        if len(path) > DEEPEST:
            raise self.refusal(event, TOO_DEEP)
        self.source.positions.setdefault(path, _place(event))
        if isinstance(event, yaml.AliasEvent):
            return self.repeat(event, path)
        if event.anchor is None:
            return self.content(event, path)
        recorded = [event]
        self.recorders.append(recorded)
        data = self.content(event, path)
        self.recorders.pop()
        self.anchored[event.anchor] = recorded
        return data

    def repeat(self, event: Any, path: Path) -> Any:
        if event.anchor not in self.anchored:
            raise self.refusal(event, f"alias *{event.anchor} stands for nothing before it")
        following, self.events = self.events, iter(self.anchored[event.anchor])
        recorders, self.recorders = self.recorders, []
        before, self.repeating = self.repeating, True
        data = self.content(next(self.events), path)
        self.events, self.recorders, self.repeating = following, recorders, before
        return data

    def content(self, event: Any, path: Path) -> Any:
        if isinstance(event, yaml.MappingStartEvent):
            return self.mapping(path)
        if isinstance(event, yaml.SequenceStartEvent):
            items: list[Any] = []
            while not isinstance(item := self.next(), yaml.SequenceEndEvent):
                items.append(self.build(item, (*path, len(items))))
            return items
        return self.scalar(event, path)

    def mapping(self, path: Path) -> dict[str, Any]:
        made: dict[str, Any] = {}
        while not isinstance(key := self.next(), yaml.MappingEndEvent):
            if not isinstance(key, yaml.ScalarEvent):
                raise self.refusal(key, "has a key that is not a word")
            word = (*path, key.value)
            if key.value in made:
                self.fault(key, word, f"duplicate key {key.value!r}, first at line {self.source.positions[word][0]}")
                self.build(self.next(), (*path, "duplicate", key.value))
            else:
                self.source.positions[word] = _place(key)
                made[key.value] = self.build(self.next(), word)
        return made

    def scalar(self, event: Any, path: Path) -> Any:
        tag = event.tag or self.loader.resolve(yaml.ScalarNode, event.value, event.implicit)
        text, kind = event.value, tag.removeprefix("tag:yaml.org,2002:")
        if kind in ("str", "!"):
            self.source.computes = self.source.computes or OPENING in text
            return text
        if kind == "null":
            return None
        if kind == "bool" and text.lower() in ("true", "false"):
            return text.lower() == "true"
        if kind not in ("int", "float"):
            self.fault(event, path, f"tag {tag!r} is not accepted", accepted="plain values without tags")
            return None
        try:
            number = float(text.lower().replace(".inf", "inf").replace(".nan", "nan"))
            return int(text) if kind == "int" and math.isfinite(number) else number
        except ValueError:
            self.fault(event, path, "is no number", received=shown(text))
            return None

    def fault(self, event: Any, path: Path, what: str, *, received: str = "", accepted: str = "") -> None:
        where = dotted(path)
        self.source.faults.append(Fault(self.source.name, *_place(event), where, what, received, accepted))

    def refusal(self, event: Any, what: str) -> WorldError:
        return WorldError([*self.source.faults, Fault(self.source.name, *_place(event), "", what)])


def _place(event: Any) -> Position:
    return event.start_mark.line + 1, event.start_mark.column + 1
