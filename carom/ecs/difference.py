"""Difference: where two worlds, or two snapshots, first differ, to the last bit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from carom.ecs.changes import bits
from carom.ecs.column import Integers
from carom.ecs.component import Component, Record
from carom.ecs.entity import INDEX_MASK
from carom.ecs.slots import Rows
from carom.ecs.snapshot import Snapshot, look_at
from carom.ecs.world import World

EVERY: Any = slice(None)


@dataclass(frozen=True)
class Difference:
    """One thing that two states do not share, as a sentence (``what``) and in parts, empty where they do not apply.

    ``entity`` is a name (for the row of a relation: the names it holds), ``row`` that of a relation, ``index`` the
    element of the column, ``ulps`` how many floating-point numbers one value is from the other. `first_divergence`
    adds the ``system`` that made it, its phase, and which run of it in the frame that was, from 1.
    """

    what: str
    frame: int
    first: Any = None
    second: Any = None
    entity: str = ""
    component: str = ""
    column: str = ""
    row: int | None = None
    index: tuple[int, ...] = ()
    ulps: int | None = None
    system: str = ""
    phase: str = ""
    run: int = 0

    def __str__(self) -> str:
        """Return one sentence."""
        by = f", system '{self.system}', run {self.run} in phase '{self.phase}'" if self.system else ""
        by += f", set by code outside before frame {self.frame + 1}" if self.phase and not self.system else ""
        return f"frame {self.frame}{by}: {self.what}"


def first_difference(a: World | Snapshot, b: World | Snapshot) -> Difference | None:
    """Return the first difference between the states of two worlds or snapshots, None when every bit is the same.

    The order is: frame, who lives, for each component by name who has it and then what differs in the lowest row, those
    without state last, the relations likewise, resources, handles given back. Entities are compared by handle, whatever
    their rows.
    """
    one, other = (look_at(state) if isinstance(state, World) else state for state in (a, b))
    return next(differences(one, other), None)


def ulps_between(x: Any, y: Any) -> int | None:
    """Return how many floating-point numbers one float is from another of its type; None for anything else or NaN."""
    if not (isinstance(x, np.floating) and isinstance(y, np.floating)) or np.isnan(x) or np.isnan(y):
        return None
    places = []
    for value in (x, y):  # the bits of positive floats count upwards from 0, those of negative ones from the sign bit
        sign = 1 << (8 * value.itemsize - 1)
        place = int(value.view(f"u{value.itemsize}"))
        places.append(place if place < sign else sign - place)
    return abs(places[0] - places[1])


def differences(a: Snapshot, b: Snapshot) -> Iterator[Difference]:
    """Yield what differs between two snapshots over the columns both hold, one difference per kind and matter."""
    frame = a.frame
    if frame != b.frame:
        yield Difference(f"the second is in frame {b.frame}", frame, frame, b.frame)
    here, there = a.living(), b.living()
    yield from _only_one(a, b, here, there, "", "lives")
    if not np.array_equal(here, there):
        yield Difference("the same entities stand in another order", frame)
    for kind in sorted({*a.tables, *b.tables}, key=_order):
        yield from _of_component(a, b, kind) if issubclass(kind, Component) else _of_relation(a, b, kind)
    for resource in sorted({*a.resources, *b.resources}, key=lambda kind: kind.__name__):
        held, other = a.resources.get(resource), b.resources.get(resource)
        if held != other:
            name = resource.__name__
            yield Difference(f"resource {name} holds something else", frame, held, other, component=name)
    given_back = np.zeros((2, max(len(a.slots["generations"]), len(b.slots["generations"]))), np.int32)
    for row, state in zip(given_back, (a, b), strict=True):
        row[: len(state.slots["generations"])] = state.slots["generations"]
    for index in np.nonzero(given_back[0] != given_back[1])[0][:1].tolist():
        first, second = given_back[:, index].tolist()
        what = f"times that id {index} was given back: {first} in the first and {second} in the second"
        yield Difference(what, frame, first, second)


def _order(kind: type[Record]) -> tuple[bool, bool, str]:
    """Return what kinds are sorted by: what follows from state says less than the state it follows from."""
    state = any(column.role == "state" for column in kind.columns.values())
    return not issubclass(kind, Component), bool(kind.columns) and not state, kind.key


def _of_component(a: Snapshot, b: Snapshot, kind: type[Record]) -> Iterator[Difference]:
    here, there = a.handles(a.numbers(kind)), b.handles(b.numbers(kind))
    yield from _only_one(a, b, here, there, kind.__name__, f"has {kind.__name__}")
    shared, in_a, in_b = here, EVERY, EVERY
    if not np.array_equal(here, there):
        _, in_a, in_b = np.intersect1d(here, there, assume_unique=True, return_indices=True)
        order = np.argsort(in_a)
        shared, in_a, in_b = here[in_a[order]], in_a[order], in_b[order]
    for found, place in _of_columns(a, b, kind, in_a, in_b):
        entity = a.name(int(shared[place]))
        yield _told(found, f" of entity '{entity}'", entity)


def _of_relation(a: Snapshot, b: Snapshot, kind: type[Record]) -> Iterator[Difference]:
    first, second = len(a.numbers(kind)), len(b.numbers(kind))
    both = slice(0, min(first, second))
    for found, row in _of_columns(a, b, kind, both, both):
        arrays = a.tables[kind][1]
        linked = [name for name, column in kind.columns.items() if column.holds == "entities" and name in arrays]
        entity = ", ".join(a.name(int(arrays[name][row])) for name in linked)
        yield replace(_told(found, f" in row {row} ({entity})" if entity else f" in row {row}", entity), row=row)
    if first != second:
        what = f"{kind.__name__} has {first} rows in the first and {second} in the second"
        yield Difference(what, a.frame, first, second, component=kind.__name__, row=both.stop)


def _of_columns(
    a: Snapshot, b: Snapshot, kind: type[Record], here: Rows, there: Rows
) -> Iterator[tuple[Difference, int]]:
    """Yield the first difference in the lowest row that has one, with its place in ``here``."""
    if kind not in a.tables or kind not in b.tables:
        return
    (_, arrays), (_, others) = a.tables[kind], b.tables[kind]
    shared = [name for name in kind.columns if name in arrays and name in others]
    pairs = {name: (arrays[name][here], others[name][there]) for name in shared}
    differs = {name: bits(x) != bits(y) for name, (x, y) in pairs.items()}
    lowest = {name: int(np.nonzero(mask)[0][0]) for name, mask in differs.items() if mask.any()}
    if not lowest:
        return
    name = min(lowest, key=lambda name: lowest[name])
    place, column = lowest[name], kind.columns[name]
    index = tuple(map(int, np.unravel_index(int(differs[name][place].argmax()), column.shape)))
    x, y = (values[place][index] for values in pairs[name])
    first, second = (a.name(int(x)), b.name(int(y))) if column.holds == "entities" else (x.item(), y.item())
    what = f"{kind.__name__}.{name}" + (str(list(index)) if index else "")
    yield (
        Difference(
            what, a.frame, first, second, component=kind.__name__, column=name, index=index, ulps=ulps_between(x, y)
        ),
        place,
    )


def _told(found: Difference, where: str, entity: str) -> Difference:
    apart = "" if found.ulps is None else f", {found.ulps} {'ulp' if found.ulps == 1 else 'ulps'} apart"
    what = f"{found.what}{where} is {found.first!r} in the first and {found.second!r} in the second{apart}"
    return replace(found, what=what, entity=entity)


def _only_one(a: Snapshot, b: Snapshot, here: Integers, there: Integers, kind: str, verb: str) -> Iterator[Difference]:
    if not np.array_equal(here, there) and len(only := np.setxor1d(here, there)):
        handle = int(only[np.argmin(only & INDEX_MASK)])
        which, state = ("first", a) if handle in here else ("second", b)
        name = state.name(handle)
        yield Difference(f"entity '{name}' {verb} only in the {which}", a.frame, entity=name, component=kind)
