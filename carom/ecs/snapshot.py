"""Snapshots: all state of a world as arrays, restored to a bit-identical future; and the hash of that state."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs.component import Component, Record, Relation, Resource
from carom.ecs.errors import SnapshotError
from carom.ecs.world import World

Arrays = dict[str, npt.NDArray[Any]]
SAVED = ("state", "input")


@dataclass(frozen=True)
class Snapshot:
    """Every saved column of the present rows in row order, who lives, and the saved part of each resource."""

    frame: int
    alive: npt.NDArray[np.bool_]
    generations: npt.NDArray[np.int64]
    tables: dict[type[Record], tuple[npt.NDArray[np.int64], Arrays]]
    resources: dict[type[Resource], bytes]


def rows_of(world: World, kind: type[Record]) -> npt.NDArray[np.int64]:
    """Return the present rows of a component, or all rows of a relation."""
    if issubclass(kind, Relation):
        return np.arange(world.count(kind))
    assert issubclass(kind, Component)
    return world.row_numbers(kind)


def saved_kinds(world: World) -> list[type[Record]]:
    """Return the kinds with at least one saved column, in order of name."""
    kinds = [k for k in world.tables if any(c.role in SAVED for c in k.columns.values())]
    return sorted(kinds, key=lambda kind: kind.key)


def take_snapshot(world: World) -> Snapshot:
    """Copy all state of a world."""
    tables: dict[type[Record], tuple[npt.NDArray[np.int64], Arrays]] = {}
    for kind in world.tables:  # who has a component is state, also where its columns are not
        if issubclass(kind, Component):
            tables[kind] = (rows_of(world, kind), {})
    for kind in saved_kinds(world):
        rows = rows_of(world, kind)
        arrays = world.table(kind).arrays
        tables[kind] = (rows, {n: arrays[n][rows] for n, c in kind.columns.items() if c.role in SAVED})
    resources = {k: s for k, r in world.resources.items() if (s := r.state()) is not None}
    used = world.used()
    return Snapshot(world.frame, world.alive[:used].copy(), world.generations[:used].copy(), tables, resources)


def restore_snapshot(world: World, snapshot: Snapshot) -> None:
    """Make a world what it was when the snapshot was taken; raise SnapshotError when it is of another kind of world."""
    missing = [kind.__name__ for kind in snapshot.resources if kind not in world.resources]
    if missing:
        raise SnapshotError(f"the snapshot holds {', '.join(missing)}, which this world does not have")
    world.reset(snapshot.alive, snapshot.generations, snapshot.frame)
    for kind in [*world.tables, *(k for k in snapshot.tables if k not in world.tables)]:
        rows, arrays = snapshot.tables.get(kind, (np.zeros(0, np.int64), {}))
        table = world.table(kind)
        if issubclass(kind, Relation):
            table.resize(len(rows))
        else:
            table.clear(slice(None))
            table.fill(rows, None)
        for name, values in arrays.items():
            table.arrays[name][rows] = values
    for resource, state in snapshot.resources.items():
        world.resources[resource].restore(state)


def state_hash(world: World) -> str:
    """Return 32 hexadecimal digits of all state; equal on every machine for the same past."""
    digest = hashlib.blake2b(digest_size=16)
    for kind in saved_kinds(world):
        rows = rows_of(world, kind)
        if len(rows):
            digest.update(kind.key.encode())
            digest.update(np.ascontiguousarray(rows).tobytes())
        for name, column in kind.columns.items():
            if column.role in SAVED:
                digest.update(np.ascontiguousarray(world.table(kind).arrays[name][rows]).tobytes())
    for resource in sorted(world.resources, key=lambda kind: kind.__name__):
        state = world.resources[resource].state()
        if state is not None:
            digest.update(state)
    return digest.hexdigest()
