"""Snapshots: all state of a world as arrays, restored to a bit-identical future; and the hash of that state."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from xxhash import xxh3_128

from carom.ecs.column import Integers
from carom.ecs.component import Component, Record, Relation, Resource
from carom.ecs.errors import SnapshotError
from carom.ecs.slots import Rows
from carom.ecs.world import World

Arrays = dict[str, npt.NDArray[Any]]
SAVED = ("state", "input")
ALIGNMENT = 64  # bytes, of a cache line


@dataclass(frozen=True)
class Snapshot:
    """Every saved column of the present rows in row order, who lives, and the saved part of each resource."""

    frame: int
    slots: Arrays
    tables: dict[type[Record], tuple[Rows, Arrays]]
    resources: dict[type[Resource], bytes]


class Block:
    """Memory for many arrays in one piece: the system hands out one large piece ten times faster than many."""

    def __init__(self, size: int) -> None:
        self.memory = np.empty(size, np.uint8)
        self.taken = 0

    def copy(self, array: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Return a copy of ``array`` in the next free part."""
        part = self.memory[self.taken : self.taken + array.nbytes].view(array.dtype).reshape(array.shape)
        self.taken += -(-array.nbytes // ALIGNMENT) * ALIGNMENT
        part[...] = array
        return part


def rows_of(world: World, kind: type[Record]) -> Rows:
    """Return the present rows of a component, or all rows of a relation."""
    if issubclass(kind, Relation):
        return slice(0, world.count(kind))
    assert issubclass(kind, Component)
    return world.rows(kind)


def row_numbers_of(world: World, kind: type[Record]) -> Integers:
    """Return the same rows always as an array."""
    rows = rows_of(world, kind)
    return np.arange(rows.start, rows.stop) if isinstance(rows, slice) else rows


def saved_columns(kind: type[Record]) -> list[str]:
    """Return the columns of a kind that are state."""
    return [name for name, column in kind.columns.items() if column.role in SAVED]


def saved_kinds(world: World) -> list[type[Record]]:
    """Return the kinds that hold state, in order of name: those with a saved column, and tags."""
    return sorted((kind for kind in world.tables if saved_columns(kind) or not kind.columns), key=lambda kind: kind.key)


def take_snapshot(world: World) -> Snapshot:
    """Copy all state of a world."""
    sources: dict[type[Record], tuple[Rows, Arrays]] = {}
    for kind, table in world.tables.items():  # who has a component is state, also where its columns are not
        saved = saved_columns(kind)
        if saved or issubclass(kind, Component):
            rows = rows_of(world, kind)
            sources[kind] = (rows, {name: table.arrays[name][rows] for name in saved})
    block = Block(sum(array.nbytes + ALIGNMENT for _, arrays in sources.values() for array in arrays.values()))
    tables = {k: (rows, {n: block.copy(array) for n, array in arrays.items()}) for k, (rows, arrays) in sources.items()}
    resources = {k: s for k, r in world.resources.items() if (s := r.state()) is not None}
    return Snapshot(world.frame, world.slots.state(), tables, resources)


def restore_snapshot(world: World, snapshot: Snapshot) -> None:
    """Make a world what it was when the snapshot was taken; raise SnapshotError when it is of another kind of world."""
    missing = [kind.__name__ for kind in snapshot.resources if kind not in world.resources]
    if missing:
        raise SnapshotError(f"the snapshot holds {', '.join(missing)}, which this world does not have")
    world.begin_restore(snapshot.slots, snapshot.frame)
    for kind in {*world.tables, *snapshot.tables}:
        rows, arrays = snapshot.tables.get(kind, (slice(0, 0), {}))
        world.table(kind).restore(rows, arrays)
    for resource, state in snapshot.resources.items():
        world.resources[resource].restore(state)


def state_hash(world: World) -> str:
    """Return 32 hexadecimal digits of all state; equal on every machine for the same past.

    XXH3 (Collet, xxHash, 2019), 128 bits: made to find differences, not to withstand forgery. Rows count by the handles
    of their entities in order of rows, so that `World.compact` changes nothing.
    """
    digest = xxh3_128()

    def add(array: npt.NDArray[Any]) -> None:
        digest.update(np.ascontiguousarray(array).data)

    handles = world.handles()
    for kind in saved_kinds(world):
        rows = rows_of(world, kind)
        held = handles[rows] if issubclass(kind, Component) else row_numbers_of(world, kind)
        if len(held):
            digest.update(kind.key.encode())
            add(held)
            for name in saved_columns(kind):
                add(world.table(kind).arrays[name][rows])
    given_back = np.nonzero(world.slots.generations)[0]
    add(given_back)
    add(world.slots.generations[given_back])
    for resource in sorted(world.resources, key=lambda kind: kind.__name__):
        state = world.resources[resource].state()
        if state is not None:
            digest.update(state)
    return digest.hexdigest()
