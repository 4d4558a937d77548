"""Growing: from the events of the parser, and what stands between them, the tree of a text."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

import yaml

from carom.worlds.layout.tree import Collection, Entry, Node, Scalar
from carom.worlds.reader import Loader

WORD = re.compile(r"[A-Za-z_][\w.]*(?: [\w.]+)*", re.ASCII)
HEADER = re.compile(r"(?P<kind>[|>][-+\d]*)\s*(?P<comment>#.*)?")


def grown(text: str) -> Collection:
    """Return the tree of a text that `read` reads to a mapping without faults."""
    return _Grower(text.replace("\r\n", "\n").replace("\r", "\n")).document()


class _Grower:
    def __init__(self, text: str) -> None:
        self.text = text
        self.loader = Loader(text)
        self.events: Iterator[Any] = iter(self.loader.get_event, None)
        self.cursor = 0
        self.waiting: list[tuple[int, str]] = []  # comments with their column, that belong to what comes
        self.latest: Entry | None = None  # beside which a comment of the same line stands

    def document(self) -> Collection:
        next(self.events), next(self.events)  # the start of the stream and of the document
        root = self.collection(next(self.events), None)
        self.reach(len(self.text))
        root.tail += self.take()
        return root

    def reach(self, index: int) -> None:
        """Note the comments and blank lines up to a place in the text; only comments have a ``#`` there."""
        fragments = self.text[self.cursor : index].split("\n")
        for number, fragment in enumerate(fragments):
            before, sign, comment = fragment.partition("#")
            if sign and number == 0 and self.latest is not None:
                self.latest.beside.append("#" + comment.rstrip())
            elif sign:
                self.waiting.append((len(before), "#" + comment.rstrip()))
            elif not before.strip() and 0 < number < len(fragments) - 1 and (not self.waiting or self.waiting[-1][1]):
                self.waiting.append((len(self.text), ""))
        if len(fragments) > 1:
            self.latest = None
        self.cursor = index

    def take(self) -> list[str]:
        taken, self.waiting = [comment for _, comment in self.waiting], []
        return taken

    def node(self, event: Any, owner: Entry) -> Node:
        self.reach(event.start_mark.index)
        if isinstance(event, (yaml.MappingStartEvent, yaml.SequenceStartEvent)):
            return self.collection(event, owner)
        owner.above += self.take()
        return self.scalar(event, owner)

    def collection(self, event: Any, owner: Entry | None) -> Collection:
        kind = dict if isinstance(event, yaml.MappingStartEvent) else list
        made = Collection(kind, event.flow_style, f"&{event.anchor}" if event.anchor else "")
        column = event.start_mark.column
        indented = kind is dict or owner is None or column >= owner.place[1]  # a list may stand right under its key
        if event.flow_style:
            self.cursor = event.end_mark.index
            if owner is not None:
                owner.above += self.take()
        item: Any
        while not isinstance(item := next(self.events), (yaml.MappingEndEvent, yaml.SequenceEndEvent)):
            self.reach(item.start_mark.index)
            place = item.start_mark.line + 1, item.start_mark.column + 1
            entry = self.latest = Entry(None, Scalar("", ""), self.take(), place)
            if made.anchor and not made.entries:  # where the collection begins is where its anchor stands
                column = place[1] - 1 if kind is dict or owner is None else owner.place[1]
            made.entries.append(entry)
            if kind is dict:
                entry.key = self.scalar(item, entry)
                item = next(self.events)
            entry.node = self.node(item, entry)
            if kind is list and isinstance(entry.node, Collection) and entry.node.entries:
                entry.above += entry.node.entries[0].taken()
        end: Any = item
        self.reach(end.start_mark.index)
        if event.flow_style:
            made.tail = [comment for comment in self.take() if comment]
            self.cursor, self.latest = end.end_mark.index, owner
        elif indented:
            made.tail = self.inside(column)
        return made

    def inside(self, column: int) -> list[str]:
        """Return the comments that wait and are indented like the entries before them."""
        length = 0
        for number, (start, comment) in enumerate(self.waiting):
            if start < column:
                break
            if comment:
                length = number + 1
        tail, self.waiting = self.waiting[:length], self.waiting[length:]
        return [comment for _, comment in tail]

    def scalar(self, event: Any, owner: Entry) -> Scalar:
        start, self.cursor = event.start_mark.index, event.end_mark.index
        if self.text[start : self.cursor].endswith("\n"):
            self.latest = None  # a block ends where the next line begins
        raw = self.text[start : self.cursor].rstrip()
        if isinstance(event, yaml.AliasEvent):
            return Scalar(raw, raw)
        style = event.style or ""
        if style in "|>" and style:
            return self.block(raw, event.value, owner)
        if event.anchor or event.tag:
            return Scalar(raw, event.value)
        if style in "'\"" and style:
            return Scalar(self.quoted(raw, event.value), event.value)
        return Scalar(_in_quotes(event.value) if "\n" in event.value else event.value, event.value, plain=True)

    def quoted(self, raw: str, value: str) -> str:
        text = "tag:yaml.org,2002:str"
        if WORD.fullmatch(value) and self.loader.resolve(yaml.ScalarNode, value, (True, False)) == text:
            return value
        if "\n" in raw or (raw[0] == "'" and not re.search(r'["\\\n]', value)):
            return _in_quotes(value)
        return raw

    def block(self, raw: str, value: str, owner: Entry) -> Scalar:
        first, *lines = raw.split("\n")
        header = HEADER.fullmatch(first.strip())
        if header is None or re.search(r"[+\d]", header["kind"]) or not value.strip():
            return Scalar(_in_quotes(value), value)
        if header["comment"]:
            owner.beside.append(header["comment"])
        depth = next(len(line) - len(line.lstrip(" ")) for line in lines if line.strip())
        return Scalar(header["kind"], value, block=[line[depth:] for line in lines])


def _in_quotes(value: str) -> str:
    return json.dumps(value, ensure_ascii=not value.isprintable())
