"""Words of a world as the text of a file: an entity a line where that is short enough, its origin as a comment."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from carom.worlds.importing.elements import Element

WIDTH = 120
DIGITS = 12  # of numbers: what is beyond is rounding of products of rotations
NOTHING = 1e-12  # share of the greatest number of a vector, below which one is that as well
PLAIN = re.compile(r"[A-Za-z_][\w./-]*( [\w./-]+)*")
WORDS = {"true", "false", "null"}


def text_of(head: Sequence[str], words: dict[str, Any], origins: Sequence[Element]) -> str:
    """Return the text of a world file with comments at its head, and of each entity where it was stated."""
    lines = ["carom: 1", *(f"# {line}" for line in head)]
    for key, value in words.items():
        if key == "entities":
            lines.append("entities:" if value else "entities: []")
            for entity, origin in zip(value, origins, strict=True):
                lines += [f"  {line}" for line in _entity(entity, origin)]
        elif key == "cameras":
            lines += ["cameras:", *(f"  {name}: {flow(camera)}" for name, camera in value.items())]
        else:
            lines.append(f"{key}: {flow(value)}")
    return "\n".join(lines) + "\n"


def _entity(entity: dict[str, Any], origin: Element) -> list[str]:
    """Return the lines of an entity: one, or one for each of its words."""
    file = origin.file.rpartition("/")[2]
    comment = f" # {file}:{origin.line}" if origin.line else ""
    whole = f"- {flow(entity)}{comment}"
    if len(whole) <= WIDTH - 2:
        return [whole]
    first, *others = entity.items()
    lines = [line for key, value in others for line in _lines(key, value, 4)]
    return [f"- {first[0]}: {flow(first[1])}{comment}", *(line[2:] for line in lines)]


def _lines(key: str, value: Any, indent: int) -> list[str]:
    """Return a word and its value in as many lines as keep to the width."""
    line = " " * indent + f"{key}: {flow(value)}"
    if len(line) <= WIDTH or not isinstance(value, dict):
        return [line]
    inner = [line for word, part in value.items() for line in _lines(word, part, indent + 2)]
    return [" " * indent + f"{key}:", *inner]


def flow(value: Any) -> str:
    """Return a value as YAML in one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, np.ndarray):
        value = np.where(np.abs(value) < NOTHING * np.abs(value).max(initial=0.0), 0.0, value).tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(flow, value)) + "]"
    if isinstance(value, bool) or value is None:
        return json.dumps(value)
    if isinstance(value, (int, float, np.floating, np.integer)):
        return f"{float(value) + 0.0:.{DIGITS}g}"
    text = str(value)
    return text if PLAIN.fullmatch(text) and text.lower() not in WORDS else json.dumps(text, ensure_ascii=False)
