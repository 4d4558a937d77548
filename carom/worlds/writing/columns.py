"""Columns in words: what rows hold, where it is not what they would hold anyway."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from carom.ecs import World
from carom.ecs.component import Component
from carom.systems.parameters import same
from carom.worlds.generated.columns import holds_entities
from carom.worlds.writing.names import Callings

Words = dict[str, Any]


def plain(value: Any) -> Any:
    """Return a value as a file holds it: lists, mappings, texts and numbers of Python."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    return [plain(item) for item in value] if isinstance(value, (list, tuple)) else value


def sayable(value: Any) -> bool:
    """Tell whether a file can say a value: all of its numbers are finite."""
    if isinstance(value, float):
        return math.isfinite(value)
    items = value.values() if isinstance(value, dict) else value if isinstance(value, (list, tuple)) else ()
    return all(map(sayable, items))


def color_words(color: Iterable[float]) -> str | list[float]:
    """Return a colour as ``#rrggbb`` where that means the same, else as numbers."""
    parts = [*color]
    whole = [round(255.0 * part) for part in parts]
    if any(not same(float(part), number / 255.0) for part, number in zip(parts, whole, strict=True)):
        return parts
    opaque = len(whole) == 4 and whole[3] == 255
    return "#" + "".join(f"{number:02x}" for number in (whole[:3] if opaque else whole))


class Columns:
    """The columns of a world, row by row; which rows hold their default is found for all at once."""

    def __init__(self, world: World) -> None:
        self.world = world
        self._others: dict[tuple[type[Component], str], list[bool]] = {}

    def has(self, kind: type[Component], row: int) -> bool:
        """Tell whether a row has a component."""
        return kind in self.world.tables and bool(self.world.tables[kind].present[row])

    def held(self, kind: type[Component], name: str, row: int) -> Any:
        """Return what one row of a column holds."""
        return self.world.table(kind).arrays[name][row].tolist()

    def stated(self, kind: type[Component], row: int, names: Iterable[str]) -> Words:
        """Return the columns of one row that hold something else than by default, as far as a file can say it."""
        values = {name: self.held(kind, name, row) for name in names if self._is_other(kind, name, row)}
        return {name: value for name, value in values.items() if sayable(value)}

    def as_made(self, row: int, made: Component) -> bool:
        """Tell whether a row of a component holds, to the bit, what a bundle for it does."""
        kind, table = type(made), self.world.table(type(made))
        if not table.present[row]:
            return False
        for name, column in kind.columns.items():
            given = getattr(made, name, None)
            if column.role != "state" or (given is None and not self._is_other(kind, name, row)):
                continue
            value = column.default if given is None else given
            if not np.shape(value):
                value = np.full(column.shape, value, column.dtype)
            if np.asarray(value, column.dtype).tobytes() != table.arrays[name][row].tobytes():
                return False
        return True

    def own_words(self, kind: type[Component], row: int, callings: Callings) -> Words:
        """Return the words of a component that is stated column by column; entities are called by name."""
        words: Words = {}
        for name, column in kind.columns.items():
            if column.role == "state" and holds_entities(column):
                called = callings.all_of(self.held(kind, name, row))
                words |= {} if called is None else {name: called}
            elif column.role == "state":
                words |= self.stated(kind, row, (name,))
        return words

    def _is_other(self, kind: type[Component], name: str, row: int) -> bool:
        """Tell whether a row of a column differs from the default in any bit."""
        if (kind, name) not in self._others:
            array, column = self.world.table(kind).arrays[name][: self.world.used()], kind.columns[name]
            usual = np.array(np.broadcast_to(np.asarray(column.default, column.dtype), column.shape))
            width = usual.nbytes
            rows = np.ascontiguousarray(array).view(np.uint8).reshape(len(array), width)
            self._others[kind, name] = (rows != usual.reshape(-1).view(np.uint8)).any(axis=1).tolist()
        return self._others[kind, name][row]
