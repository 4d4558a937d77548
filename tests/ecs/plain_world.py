"""A world as plain dicts and lists, slow and obvious: what the state machine holds the table against."""

from __future__ import annotations

import copy
from collections.abc import Iterable
from typing import Any

import numpy as np

from carom.ecs import Component, Name, Parent, Relation, column, tag
from carom.ecs.component import Record
from carom.ecs.entity import INDEX_MASK

Values = dict[str, np.ndarray]


class Place(Component):
    """Numbers."""

    position = column(3, unit="m", doc="where")
    turns = column(unit="1", doc="how often", dtype="int32", default=7)


class Link(Component):
    """An entity, and a row that follows it by chance."""

    target = column(unit="1", doc="whom", holds="entities")
    row = column(unit="1", doc="which row", holds="rows", role="derived")


class Bond(Relation):
    """Rows of their own that point at entities."""

    who = column(unit="1", doc="whom", holds="entities")
    row = column(unit="1", doc="which row", holds="rows", role="derived")


for _key in ("place", "link", "bond"):
    Record.registry.pop(_key)

RED = tag("red_in_machine")
KINDS: tuple[type[Component], ...] = (Place, Link, RED, Name, Parent)
WATCHED = (Place, Link)


class PlainWorld:
    """Who stands in which row, and what each entity holds."""

    def __init__(self) -> None:
        self.rows: list[int | None] = []
        self.held: dict[int, dict[type[Component], Values]] = {}
        self.generations: dict[int, int] = {}
        self.bonds: list[tuple[int, int]] = []
        self.seen: dict[type[Component], dict[int, tuple[bytes, ...]]] = {kind: {} for kind in WATCHED}
        self.changed: dict[type[Component], dict[int, int]] = {kind: {} for kind in WATCHED}

    def first_row(self, count: int) -> int:
        """Return where ``count`` new ones would stand: the lowest gap that holds them, else the end."""
        for first in range(len(self.rows) - count + 1):
            if count and self.rows[first : first + count] == [None] * count:
                return first
        return len(self.rows)

    def place(self, first: int, handles: list[int]) -> None:
        """Let new entities stand from row ``first`` on."""
        self.rows += [None] * (first + len(handles) - len(self.rows))
        self.rows[first : first + len(handles)] = handles
        self.held.update((handle, {}) for handle in handles)

    def fill(self, handle: int, kind: type[Component], values: dict[str, Any]) -> None:
        """Give one entity a component, with defaults where no value is stated."""
        self.held[handle][kind] = {
            name: np.broadcast_to(np.asarray(values.get(name, declared.default), declared.dtype), declared.shape).copy()
            for name, declared in kind.columns.items()
        }

    def family(self, handles: Iterable[int]) -> set[int]:
        """Return these and everyone they carry."""
        found, size = set(handles), -1
        while size != len(found):
            size = len(found)
            found |= {h for h, held in self.held.items() if Parent in held and int(held[Parent]["entity"]) in found}
        return found

    def despawn(self, handles: Iterable[int]) -> None:
        """Remove them and everyone they carry."""
        for handle in self.family(handles):
            self.rows[self.rows.index(handle)] = None
            self.generations[handle & INDEX_MASK] = (handle >> 32) + 1
            del self.held[handle]
        while self.rows and self.rows[-1] is None:
            self.rows.pop()

    def compact(self) -> None:
        """Close the gaps; rows that columns hold follow, -1 where nobody stands any more."""
        living = [row for row, handle in enumerate(self.rows) if handle is not None]
        new = {row: living.index(row) if row in living else -1 for row in range(len(self.rows))}
        self.bonds = [(who, new.get(row, row)) for who, row in self.bonds]
        for held in self.held.values():
            if Link in held:
                row = int(held[Link]["row"])
                held[Link]["row"] = np.array(new.get(row, row))
        self.rows = [handle for handle in self.rows if handle is not None]

    def saved(self) -> PlainWorld:
        """Return what a snapshot keeps: all but derived columns, which are as if never written."""
        kept = copy.deepcopy(self)
        kept.bonds = [(who, -1) for who, _ in self.bonds]
        for held in kept.held.values():
            if Link in held:
                held[Link]["row"] = np.array(-1)
        return kept

    def restore(self, saved: PlainWorld) -> None:
        """Become what was saved; what was seen of changes stays."""
        kept = copy.deepcopy(saved)
        self.rows, self.held, self.generations, self.bonds = kept.rows, kept.held, kept.generations, kept.bonds

    def matching(
        self, kinds: Iterable[type[Component]], without: Iterable[type[Component]], any_of: Iterable[type[Component]]
    ) -> list[int]:
        """Return the rows of a query."""
        some = set(any_of)
        return [
            row
            for row, handle in enumerate(self.rows)
            if handle is not None
            and set(kinds) <= self.held[handle].keys()
            and not self.held[handle].keys() & set(without)
            and (not some or self.held[handle].keys() & some)
        ]

    def look(self, mark: int) -> None:
        """Note what differs from what was last seen."""
        for kind in WATCHED:
            now = {h: tuple(v.tobytes() for v in held[kind].values()) for h, held in self.held.items() if kind in held}
            before, self.seen[kind] = self.seen[kind], now
            noted = self.changed[kind]
            self.changed[kind] = {h: noted[h] if before.get(h) == value else mark for h, value in now.items()}

    def state(self) -> Any:
        """Return everything a state hash must tell apart, and nothing else."""
        rows = [
            (handle, sorted((kind.key, [v[n].tobytes() for n in v if n != "row"]) for kind, v in held.items()))
            for handle, held in ((handle, self.held[handle]) for handle in self.rows if handle is not None)
        ]
        return repr((rows, sorted(self.generations.items()), [who for who, _ in self.bonds]))
