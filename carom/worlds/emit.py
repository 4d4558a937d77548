"""Emit: plain data as the text of a world file, one line for what fits on it."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

WIDTH = 140  # columns that a line may have
PLAIN = re.compile(r"[A-Za-z_\d](?:[\w ./%*()<>=+-]*[\w./%*()<>=+-])?")
NUMBER = re.compile(r"\d[\d.]*(?:[eE][-+]?\d+)?")
TAKEN = ("true", "false", "null", "yes", "no", "on", "off")  # which other readers of YAML take for something else


def emit(data: Mapping[str, Any]) -> str:
    """Return the text of a world: what does not fit on a line takes a line for each of its parts, as do its lists.

    Floats are the shortest text that reads as the same bits. Texts of several lines keep them.
    """
    return "\n".join(line for key, value in data.items() for line in _entry(f"{_text(key)}:", value, 0)) + "\n"


def _entry(head: str, value: Any, indent: int) -> list[str]:
    """Return the lines of a value behind a key, or behind the dash of a list."""
    if isinstance(value, str) and "\n" in value:
        return [f"{' ' * indent}{head} |", *(" " * (indent + 2) + line for line in value.splitlines())]
    line, listed = f"{' ' * indent}{head} {flow(value)}", isinstance(value, (list, tuple)) and not indent
    if not _parted(value) or (len(line) <= WIDTH and not listed):
        return [line]
    inner = indent + 2
    if isinstance(value, Mapping):
        lines = [line for key, item in value.items() for line in _entry(f"{_text(key)}:", item, inner)]
    else:
        lines = [line for item in value for line in _entry("-", item, inner)]
    if head != "-":
        return [f"{' ' * indent}{head}", *lines]
    return [f"{' ' * indent}- {lines[0].lstrip()}", *lines[1:]]


def _parted(value: Any) -> bool:
    """Tell whether there is anything to part but numbers and words."""
    if isinstance(value, (list, tuple)):
        return any(isinstance(item, (Mapping, list, tuple)) for item in value)
    return isinstance(value, Mapping) and bool(value)


def flow(value: Any) -> str:
    """Return a value in one line."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_text(key)}: {flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(flow, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return _number(value)
    if value is None:
        return "null"
    return _text(value) if isinstance(value, str) else repr(value)


def _number(value: float) -> str:
    text = float.__repr__(value)
    return text.removesuffix(".0") if text != "-0.0" else text


def _text(value: str) -> str:
    plain = PLAIN.fullmatch(value) and not NUMBER.fullmatch(value) and value.lower() not in TAKEN
    return value if plain else json.dumps(value, ensure_ascii=False)
