"""Tree: the plain data of a world file, and what there is in it to take out or to write shorter."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from copy import deepcopy
from typing import Any, NamedTuple

from carom.worlds.emit import flow
from carom.worlds.errors import Path
from carom.worlds.source import OPENING
from carom.worlds.units import NUMBER

KEPT = ("carom", "run")  # sections without which there is no world, or another length of it
VALUE = re.compile(rf"({NUMBER})(\s*[A-Za-z%].*)?")
REMOVED = object()


class Edit(NamedTuple):
    """What stands at a path becomes another value, or is removed."""

    path: Path
    value: Any = REMOVED


def edited(tree: dict[str, Any], edits: Iterable[Edit]) -> dict[str, Any]:
    """Return a copy of a tree with all edits; paths are those of ``tree``."""
    made = deepcopy(tree)
    for path, value in sorted(dict(edits).items(), key=lambda edit: edit[0], reverse=True):  # the last items first
        parent = at(made, path[:-1])
        if value is REMOVED:
            del parent[path[-1]]
        else:
            parent[path[-1]] = value
    return made


def at(tree: Any, path: Path) -> Any:
    """Return what stands at a path."""
    for step in path:
        tree = tree[step]
    return tree


def nodes(tree: dict[str, Any], depth: int) -> list[Path]:
    """Return the paths of everything that can be removed ``depth`` steps below the root."""
    found: list[Path] = [(key,) for key in tree if key not in KEPT]
    for _ in range(depth - 1):
        found = [(*path, step) for path in found for step in _parts(at(tree, path))]
    return found


def _parts(value: Any) -> Iterable[str | int]:
    """Return the steps to the parts of a value that it may do without: numbers of a list belong together."""
    if isinstance(value, dict):
        return list(value)
    return range(len(value)) if isinstance(value, list) and not any(map(_is_number, value)) else ()


def _is_number(value: Any) -> bool:
    return not isinstance(value, (dict, list, str)) or (
        isinstance(value, str) and (OPENING in value or VALUE.fullmatch(value) is not None)
    )


def leaves(tree: Any, path: Path = ()) -> Iterator[tuple[Path, Any]]:
    """Yield every value that has no parts, with its path."""
    steps = tree if isinstance(tree, dict) else range(len(tree)) if isinstance(tree, list) else ()
    for step in steps:
        yield from leaves(tree[step], (*path, step))
    if not isinstance(tree, (dict, list)):
        yield path, tree


def shorter_numbers(tree: dict[str, Any], digits: int) -> list[Edit]:
    """Return the edits that leave numbers so many significant digits, where that is shorter; 0 digits are the number 0.

    Units are kept.
    """
    found = []
    for path, value in leaves(tree):
        shorter = _rounded(value, digits) if path[0] not in KEPT else value
        if shorter != value and (digits == 0 or len(flow(shorter)) < len(flow(value))):
            found.append(Edit(path, shorter))
    return found


def _rounded(value: Any, digits: int) -> Any:
    if isinstance(value, str):
        match = VALUE.fullmatch(value)
        return value if match is None else flow(_rounded(float(match[1]), digits)) + (match[2] or "")
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return value
    rounded = float(f"{value:.{digits}g}") if digits else 0.0
    return int(rounded) if rounded.is_integer() and abs(rounded) < 1e6 else rounded


def lower_counts(tree: dict[str, Any], lower: Callable[[int], int]) -> list[Edit]:
    """Return the edits that let generators make fewer copies."""
    counted = [(path, value) for path, value in leaves(tree) if "count" in path[-2:] and isinstance(value, int)]
    return [Edit(path, lower(value)) for path, value in counted if value > 1]


def owner(tree: dict[str, Any], dotted: str) -> Path | None:
    """Return the item of a list, or else of a section, around a path as messages tell it; None for what is of none."""
    path: Path = ()
    value: Any = tree
    while dotted:
        steps = value if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ()
        fitting = [step for step in steps if f"{dotted}.".startswith(f"{step}.")]
        if not fitting:
            break
        step = max(fitting, key=lambda step: len(str(step)))  # keys may have dots in them
        path, value, dotted = (*path, step), value[step], dotted[len(str(step)) + 1 :]
    ends = range(1, len(path) + 1)
    items = [end for end in ends if isinstance(path[end - 1], int) and _parts(at(tree, path[: end - 1]))]
    length = items[-1] if items else 2
    return path[:length] if len(path) >= length and path[0] not in KEPT else None
