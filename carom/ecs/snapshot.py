"""Snapshots: all state of a world as arrays, restored to a bit-identical future; and the hash of that state."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt
from xxhash import xxh3_128

from carom.ecs.column import Integers
from carom.ecs.component import Component, Record, Resource
from carom.ecs.components.name import Name
from carom.ecs.entity import INDEX_BITS, INDEX_MASK
from carom.ecs.errors import SnapshotError
from carom.ecs.names import NOBODY
from carom.ecs.slots import Rows, as_numbers
from carom.ecs.snapshot_faults import SAVED, Arrays, faults_of
from carom.ecs.world import World

ALIGNMENT = 64  # bytes, of a cache line
NOTHING = np.empty(0, np.uint8)


@dataclass(frozen=True, eq=False)
class Snapshot:
    """Every saved column of the present rows in row order, who lives, and the saved part of each resource.

    ``edited`` are the kinds that code outside has opened since the last step, which the next one is to answer.
    """

    frame: int
    slots: Arrays
    tables: dict[type[Record], tuple[Rows, Arrays]]
    resources: dict[type[Resource], bytes]
    edited: frozenset[type[Record]] = frozenset()
    memory: npt.NDArray[np.uint8] = field(default_factory=lambda: NOTHING, repr=False)

    def numbers(self, kind: type[Record]) -> Integers:
        """Return the rows of a kind as an array."""
        return as_numbers(self.tables[kind][0] if kind in self.tables else slice(0, 0))

    def handles(self, rows: Integers) -> Integers:
        """Return the handles of the entities in rows."""
        ids = rows + self.slots["id_shift"][rows]
        return np.asarray(self.slots["generations"][ids].astype(np.int64) << INDEX_BITS | ids)

    def living(self) -> Integers:
        """Return all handles, in order of rows."""
        return self.handles(np.nonzero(self.slots["alive"])[0])

    def name(self, entity: int) -> str:
        """Return the name of an entity, its number in brackets when it has none; ``none`` for no entity."""
        place = np.nonzero(self.handles(self.numbers(Name)) == entity)[0]
        text = str(self.tables[Name][1]["text"][place[0]]) if len(place) else ""
        return text or ("none" if entity == NOBODY else f"[{entity & INDEX_MASK}]")


class Block:
    """Memory for many arrays in one piece: the system hands out one large piece ten times faster than many.

    Memory that was in use before is taken where it suffices: touching new one costs far more than the copying.
    """

    def __init__(self, size: int, used_before: npt.NDArray[np.uint8]) -> None:
        self.memory = used_before if used_before.size >= size else np.empty(size, np.uint8)
        self.taken = 0

    def copy(self, array: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Return a copy of ``array`` in the next free part."""
        part = self.memory[self.taken : self.taken + array.nbytes].view(array.dtype).reshape(array.shape)
        self.taken += -(-array.nbytes // ALIGNMENT) * ALIGNMENT
        part[...] = array
        return part


def held_columns(world: World, roles: Collection[str] = SAVED) -> Iterator[tuple[type[Record], Rows, list[str]]]:
    """Yield each kind that has rows, in order of name, with its rows and its columns of these roles.

    Who has a component is state, also where its columns are not; a table that was made and never filled is none.
    """
    for kind in sorted(world.tables, key=lambda kind: kind.key):
        names = [name for name, column in kind.columns.items() if column.role in roles]
        if (names or issubclass(kind, Component)) and (count := world.count(kind)):
            yield kind, world.rows(kind) if issubclass(kind, Component) else slice(0, count), names


def look_at(world: World, roles: Collection[str] = SAVED) -> Snapshot:
    """Return a snapshot of the columns of these roles in the world's own memory: it lasts until the next change."""
    tables = {
        kind: (rows, {name: world.tables[kind].read(name, rows) for name in names})
        for kind, rows, names in held_columns(world, roles)
    }
    resources = {k: s for k, r in world.resources.items() if (s := r.state()) is not None}
    edited = frozenset(kind for kind in world.edited if issubclass(kind, Record))  # resources may be opened too
    return Snapshot(world.frame, world.slots.state(), tables, resources, edited)


def take_snapshot(world: World, *, reuse: Snapshot | None = None) -> Snapshot:
    """Copy all state of a world; into the memory of a snapshot that nobody needs any more, where that suffices."""
    return copied(look_at(world), reuse)


def copied(seen: Snapshot, reuse: Snapshot | None = None) -> Snapshot:
    """Return a snapshot that shares memory with nobody."""
    size = sum(array.nbytes + ALIGNMENT for _, arrays in seen.tables.values() for array in arrays.values())
    block = Block(size, NOTHING if reuse is None else reuse.memory)
    tables = {
        kind: (rows, {name: block.copy(array) for name, array in arrays.items()})
        for kind, (rows, arrays) in seen.tables.items()
    }
    return Snapshot(seen.frame, seen.slots, tables, seen.resources, seen.edited, block.memory)


def restore_snapshot(world: World, snapshot: Snapshot) -> None:
    """Make a world what it was when the snapshot was taken.

    Raises SnapshotError, and changes nothing, when the snapshot does not fit the world or a resource refuses its part.
    """
    if faults := faults_of(snapshot, world):
        raise SnapshotError("\n  ".join(["the snapshot does not fit this world:", *faults]))
    _restore_resources(world, snapshot.resources)
    world.begin_restore(snapshot.slots, snapshot.frame, snapshot.edited)
    for kind in {*world.tables, *snapshot.tables}:
        rows, arrays = snapshot.tables.get(kind, (slice(0, 0), {}))
        world.table(kind).restore(rows, arrays)


def _restore_resources(world: World, states: dict[type[Resource], bytes]) -> None:
    """Give every resource its part, or, where one refuses, all of them what they had."""
    before: dict[type[Resource], bytes] = {}
    try:
        for kind, state in states.items():
            held = world.resources[kind].state()
            assert held is not None, "faults_of() found those that save nothing"
            before[kind] = held
            world.resources[kind].restore(state)
    except Exception:
        for kind, held in before.items():
            if world.resources[kind].state() != held:
                world.resources[kind].restore(held)
        raise


def state_hash(world: World, roles: Collection[str] = SAVED) -> str:
    """Return 32 hexadecimal digits of all state; equal on every machine for the same past.

    They are equal where `first_difference` finds nothing, and differ where it does. XXH3 (Collet, xxHash, 2019), 128
    bits: made to find differences, not to withstand forgery. Rows count by the handles of their entities in order of
    rows, so that `World.compact` changes nothing. ``roles`` are those of the columns that count.
    """
    digest = xxh3_128(str(world.frame).encode())

    def add(array: npt.NDArray[Any]) -> None:
        digest.update(np.ascontiguousarray(array).data)

    handles = world.handles()
    add(handles[world.slots.alive[: world.used()]])
    for kind, rows, names in held_columns(world, roles):
        digest.update(kind.key.encode())
        add(handles[rows] if issubclass(kind, Component) else as_numbers(rows))
        for name in names:
            add(world.table(kind).read(name, rows))
    given_back = np.nonzero(world.slots.generations)[0]
    add(given_back)
    add(world.slots.generations[given_back])
    for resource in sorted(world.resources, key=lambda kind: kind.__name__):
        state = world.resources[resource].state()
        if state is not None:
            digest.update(resource.__name__.encode())
            digest.update(state)
    return digest.hexdigest()
