"""Printing: a tree as lines of at most 120 characters, the same lines for the same tree."""

from __future__ import annotations

import re

from carom.worlds.layout.tree import Collection, Entry, Node, Scalar

WIDTH = 120
STEP = 2  # columns that each level is indented by
UNSAFE = re.compile(r"[,\[\]{}]")  # what a plain value may have outside of braces only


def lines_of(collection: Collection, indent: int) -> list[str]:
    """Return the lines of a collection that is no flow, each entry on lines of its own."""
    pad = " " * indent
    lines: list[str] = []
    for number, entry in enumerate(collection.entries):
        above = entry.above if number or indent == 0 else _without_blanks(entry.above)
        lines += [(pad + line).rstrip() for line in above]
        lines += _entry(entry, indent)
    return lines + [(pad + line).rstrip() for line in collection.tail]


def _without_blanks(above: list[str]) -> list[str]:
    return above[next((number for number, line in enumerate(above) if line), len(above)) :]


def _entry(entry: Entry, indent: int) -> list[str]:
    pad, node = " " * indent, entry.node
    head = f"{pad}-" if entry.key is None else f"{pad}{entry.key.text}:"
    beside = "".join(f"  {comment}" for comment in entry.beside)
    if isinstance(node, Collection) and is_block(node):
        under = lines_of(node, indent + STEP)
        anchor = f" {node.anchor}" if node.anchor else ""
        if entry.key is not None or anchor:
            return [head + anchor + beside, *under]
        above = [pad + comment for comment in entry.beside]
        return [*above, f"{head} {under[0].lstrip()}", *under[1:]]
    if isinstance(node, Collection):
        lines = _filled(node, len(head) + 1, 0)
    elif node.block:
        inner = " " * (indent + STEP)
        return [f"{head} {node.text}{beside}", *((inner + line).rstrip() for line in node.block)]
    else:
        lines = _folded(node, len(head) + 1, indent + STEP)
    lines[0] = f"{head} {lines[0]}".rstrip()
    lines[-1] += beside
    return lines


def is_block(node: Collection) -> bool:
    """Tell whether a collection stands on lines of its own: in braces, comments would have no place."""
    return (bool(node.entries) and (not node.flow or _commented(node))) or bool(node.tail)


def _commented(node: Node) -> bool:
    if isinstance(node, Scalar):
        return False
    return bool(node.tail) or any(entry.beside or any(entry.above) or _commented(entry.node) for entry in node.entries)


def flat(node: Node) -> str:
    """Return a node on one line, as it stands in braces."""
    if isinstance(node, Scalar):
        return f'"{node.text}"' if node.plain and UNSAFE.search(node.text) else node.text
    items = ", ".join((_head(entry) + flat(entry.node)).rstrip() for entry in node.entries)
    return _opening(node) + items + _closing(node)


def _head(entry: Entry) -> str:
    return "" if entry.key is None else f"{flat(entry.key)}: "


def _opening(node: Collection) -> str:
    return (f"{node.anchor} " if node.anchor else "") + ("{" if node.kind is dict else "[")


def _closing(node: Collection) -> str:
    return "}" if node.kind is dict else "]"


def _filled(node: Collection, column: int, after: int) -> list[str]:
    """Return a collection in braces that begins at a column; ``after`` characters follow it on its last line."""
    whole = flat(node)
    if column + len(whole) + after <= WIDTH:
        return [whole]
    lines = [_opening(node)]
    inner = " " * (column + len(lines[0]))
    for number, entry in enumerate(node.entries):
        last = entry is node.entries[-1]
        text, follows = (_head(entry) + flat(entry.node)).rstrip(), after + 1 if last else 1
        used = len(lines[-1]) + (column if len(lines) == 1 else 0)
        if number and used + 1 + len(text) + follows <= WIDTH:
            lines[-1] += f" {text}"
        else:
            if number:
                lines.append(inner)
            head = _head(entry)
            value = [text.removeprefix(head)]
            if isinstance(entry.node, Collection):
                value = _filled(entry.node, len(inner) + len(head), follows)
            lines[-1] += head + value[0]
            lines += value[1:]
        lines[-1] += _closing(node) if last else ","
    return lines


def _folded(node: Scalar, column: int, indent: int) -> list[str]:
    """Return a value on one line, a long plain text on several."""
    if not node.plain or column + len(node.text) <= WIDTH:
        return [node.text]
    lines = [""]
    for word in re.split(r"(?<! ) (?! )", node.text):
        if lines[-1].strip() and (column if len(lines) == 1 else 0) + len(lines[-1]) + 1 + len(word) > WIDTH:
            lines.append(" " * indent + word)
        else:
            lines[-1] += f" {word}" if lines[-1].strip() else word
    return lines
