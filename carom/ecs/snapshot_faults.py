"""Snapshot faults: everything about a snapshot that does not fit a world, before anything is changed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from carom.ecs.component import Record, Relation
from carom.ecs.entity import INDEX_MASK
from carom.ecs.slots import Rows, as_numbers

if TYPE_CHECKING:
    from carom.ecs.snapshot import Snapshot
    from carom.ecs.world import World

Arrays = dict[str, npt.NDArray[Any]]
SAVED = ("state", "input")  # the roles of columns that a snapshot holds


def faults_of(snapshot: Snapshot, world: World) -> list[str]:
    """Return in words all that keeps a snapshot from being restored into a world."""
    faults = list(_faults_of_slots(snapshot.slots))
    alive = snapshot.slots["alive"] if not faults else None
    for kind, (rows, arrays) in snapshot.tables.items():
        faults += _faults_of_columns(kind, arrays, len(as_numbers(rows)), len(snapshot.slots.get("generations", ())))
        if alive is not None and not _stand(kind, rows, alive):
            faults.append(f"{kind.__name__} stands in rows where nobody lives")
    savers = {kind for kind, resource in world.resources.items() if resource.state() is not None}
    for name in sorted(kind.__name__ for kind in snapshot.resources.keys() - world.resources.keys()):
        faults.append(missing_resource(name))
    for name in sorted(kind.__name__ for kind in snapshot.resources.keys() & world.resources.keys() - savers):
        faults.append(f"it holds {name}, which saves no state here")
    for name in sorted(kind.__name__ for kind in savers - snapshot.resources.keys()):
        faults.append(f"it does not hold {name}, whose state this world needs")
    return faults


def missing_resource(name: str) -> str:
    """Return the fault of a resource that only the snapshot has."""
    return f"it holds {name}, which this world does not have; add it with world.add({name}(...))"


def _faults_of_slots(slots: Arrays) -> Iterator[str]:
    wanted = {"alive": "bool", "generations": "int32", "died_at": "int64", "id_shift": "int32"}
    if {name: str(array.dtype) for name, array in slots.items()} != wanted:
        yield "its table of who lives has other columns than here"
        return
    reached = len(slots["generations"])
    ids = np.arange(len(slots["id_shift"])) + slots["id_shift"]
    whole = len(slots["died_at"]) == len(ids) == reached >= len(slots["alive"]) and not (ids < 0).any()
    if not whole or (np.bincount(ids, minlength=reached) != 1).any():
        yield "its table of who lives contradicts itself"


def _faults_of_columns(kind: type[Record], arrays: Arrays, count: int, reached: int) -> Iterator[str]:
    saved = {name: column for name, column in kind.columns.items() if column.role in SAVED}
    for name in sorted(arrays.keys() - saved.keys()):
        yield f"it holds {kind.__name__}.{name}, which is no state here"
    for name, column in saved.items():
        if name not in arrays:
            yield f"it does not hold {kind.__name__}.{name}"
            continue
        held, declared = arrays[name], (count, *column.shape)
        if held.dtype != column.dtype or held.shape != declared:
            yield (
                f"{kind.__name__}.{name} is {held.dtype} of shape {held.shape}, "
                f"declared here is {column.dtype} of shape {declared}"
            )
        elif column.holds == "entities" and ((held >= 0) & (held & INDEX_MASK >= reached)).any():
            yield f"{kind.__name__}.{name} holds entities that never lived"


def _stand(kind: type[Record], rows: Rows, alive: npt.NDArray[np.bool_]) -> bool:
    """Tell whether rows are those of the living, in order; a relation's are the first."""
    if issubclass(kind, Relation):
        return isinstance(rows, slice) and rows.start == 0
    if isinstance(rows, slice):
        return bool(rows.start >= 0 and rows.stop <= len(alive) and alive[rows].all())
    ordered = bool((np.diff(rows) > 0).all())
    return ordered and rows[0] >= 0 and rows[-1] < len(alive) and bool(alive[rows].all())
