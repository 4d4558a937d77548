"""Writes: what code outside the step has written into components, row by row, for who keeps a log of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs.changes import bits
from carom.ecs.column import Integers
from carom.ecs.component import Component, Record

if TYPE_CHECKING:
    from carom.ecs.world import World

Values = dict[str, npt.NDArray[Any]]


class Written(NamedTuple):
    """Who holds something else than before, handles (n,), and all of each (n, ...), by column."""

    entities: Integers
    columns: Values


class WriteLog:
    """What components held before code outside opened them: ``world.writes = WriteLog()`` keeps it from then on.

    Only what is opened is copied, once a step.
    """

    def __init__(self) -> None:
        self._before: dict[type[Component], tuple[int, Values]] = {}

    def open(self, world: World, kind: type[Record]) -> None:
        """Keep what a component holds, unless it has been opened since the last step."""
        if issubclass(kind, Component) and kind not in self._before:
            self._before[kind] = (
                world.structure,
                {name: world.table(kind).arrays[name][: world.used()].copy() for name in stated(kind)},
            )

    def take(self, world: World) -> dict[type[Component], Written]:
        """Return what was written since the last call, nothing where somebody came or went meanwhile."""
        before, self._before = self._before, {}
        return {
            kind: _written(world, kind, held)
            for kind, (structure, held) in before.items()
            if structure == world.structure
        }

    def forget(self) -> None:
        """Forget what was opened, since a snapshot has taken its place."""
        self._before = {}


def stated(kind: type[Component]) -> list[str]:
    """Return the names of the columns that no system can make anew."""
    return [name for name, column in kind.columns.items() if column.role in ("state", "input")]


def _written(world: World, kind: type[Component], held: Values) -> Written:
    table, used = world.table(kind), world.used()
    differs = np.zeros(used, np.bool_)
    for name, before in held.items():
        other = bits(table.arrays[name][:used]) != bits(before)
        differs |= other.reshape(used, -1).any(axis=1)
    rows = np.nonzero(differs & table.present[:used])[0]
    return Written(world.entities(rows), {name: table.arrays[name][rows] for name in held})
