"""The quantities that a world file states and its expectations must notice: gravity, masses and restitutions."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from carom.worlds import LoadedWorld, library, load_text
from carom.worlds.reader import read

FIELDS = {"mutual_gravitation": "constant", "gravity_well": "strength", "attraction": "strength"}
BY = {"gravity": 1.01, "mass": 1.05, "density": 1.05}  # restitution: by 0.1
NUMBER = re.compile(r"[-+]?[\d.]+(?:e[-+]?\d+)?")


def quantities(path: Path) -> dict[str, tuple[str, tuple[Any, ...]]]:
    """Return kind and place of each quantity of a file, by its path with names of entities instead of numbers."""
    document = _document(path)
    found = {}
    for kind, place in _stated(document):
        words: Any = document
        keys = []
        for key in place:
            words = words[key]
            keys.append(words.get("name", str(key)) if isinstance(key, int) and isinstance(words, dict) else str(key))
        found[".".join(keys)] = (kind, place)
    return found


def _stated(words: Any, place: tuple[Any, ...] = ()) -> Iterator[tuple[str, tuple[Any, ...]]]:
    for key, value in words.items() if isinstance(words, dict) else enumerate(words) if isinstance(words, list) else ():
        here = (*place, key)
        if here == ("gravity",):
            if any(value):
                yield "gravity", here
        elif key in FIELDS:
            yield "gravity", (*here, FIELDS[key])
        elif key == "restitution":
            yield "restitution", (*here, "value") if isinstance(value, dict) else here
        elif key in BY and not isinstance(value, dict) and place[:1] != ("forces",):
            yield key, here
        else:
            yield from _stated(value, here)


def _document(path: Path) -> Any:
    return read(path.read_text(encoding="utf-8"), path.name).data


def turned(name: str, place: tuple[Any, ...], kind: str) -> LoadedWorld:
    """Return a world of the library with one quantity off."""
    path = library.find(name)
    words = document = _document(path)
    for key in place[:-1]:
        words = words[key]
    words[place[-1]] = _off(words[place[-1]], kind)
    loaded = load_text(json.dumps(document), str(path))
    loaded.simulation.checked = False  # what its systems touch is guarded where all holds
    return loaded


def _off(value: Any, kind: str) -> Any:
    if isinstance(value, list):
        return [_off(one, kind) for one in value]
    if kind == "restitution":
        return value + (0.1 if value <= 0.9 else -0.1)
    if not isinstance(value, str):
        return value * BY[kind]
    if value.startswith("${"):
        return "${(" + value[2:-1] + f") * {BY[kind]}}}"
    return NUMBER.sub(lambda number: repr(float(number[0]) * BY[kind]), value, count=1)
