"""Connections: who is named by columns and joints of others, once all entities are there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from carom.ecs.column import Integers
from carom.ecs.component import Component
from carom.ecs.components.joint import Joint
from carom.systems.joints.stating import read_joint
from carom.systems.own_components import components_of_files
from carom.systems.parameters import WordFault
from carom.systems.simulation import Simulation
from carom.worlds.errors import Path, WordError
from carom.worlds.generated.columns import holds_entities
from carom.worlds.groups import Group
from carom.worlds.names import known
from carom.worlds.source import Source

if TYPE_CHECKING:
    from carom.worlds.crowd import Some


class Pointer(NamedTuple):
    """A column that holds entities, with the names the file states for it there."""

    path: Path
    kind: type[Component]
    column: str
    names: Any


class Connections:
    """Connects entities, reporting whom nobody is called like."""

    def __init__(self, source: Source, simulation: Simulation) -> None:
        self.source, self.simulation = source, simulation
        self.pointing = {
            key: (kind, names)
            for key, kind in components_of_files().items()
            if (names := [name for name, column in kind.columns.items() if holds_entities(column)])
        }
        self.pointers: list[tuple[Integers, Pointer]] = []
        self.joints: list[tuple[int, Path, dict[str, Any]]] = []

    def take_pointers(self, path: Path, words: dict[str, Any], group: Group) -> list[Pointer]:
        """Take out what names other entities, which may come later in the file."""
        return [
            Pointer((*path, key, name), kind, name, np.vectorize(group.whole, otypes=[object])(words[key].pop(name)))
            for key, (kind, names) in self.pointing.items()
            if key in words
            for name in names
            if name in words[key]
        ]

    def add(self, entities: Integers, some: Some) -> None:
        """Take what entities that are there now hold and point to."""
        self.pointers += [(entities, pointer) for pointer in some.pointers]
        if some.joint is None:
            return
        for stated in some.joint.values():
            stated |= {side: some.group.whole(stated[side]) for side in ("a", "b") if stated.get(side) is not None}
        self.joints.append((int(entities[0]), some.path, some.joint))

    def point_all(self) -> None:
        """Let columns hold the entities the file names; report unknown names, of copies those of the first."""
        world, told = self.simulation.world, set[Path]()
        names = dict.fromkeys(world.names())
        for entities, pointer in self.pointers:
            if pointer.path in told:
                continue
            column = pointer.kind.columns[pointer.column]
            try:
                found = [world.find(known("entity", str(name), names)) for name in np.ravel(pointer.names)]
            except WordError as fault:
                self.source.report_value(pointer.path, fault)
                told.add(pointer.path)
                continue
            with world.edit(pointer.kind) as table:
                getattr(table, pointer.column)[world.slots.rows(entities)] = np.reshape(found, column.shape)

    def join_all(self) -> None:
        """Let joints hold whom they name, at the poses where all are now; report everything that is wrong with them.

        Of the copies of one joint the first that is wrong is told, and not the others: they are written once.
        """
        world, told = self.simulation.world, set[Path]()
        for entity, path, words in self.joints:
            faults: list[WordFault] = []
            if path in told:
                continue
            made = read_joint(world, words, faults)
            for fault in faults:
                self.source.report_value((*path, *fault.steps), fault)
                told.add(path)
            if made is not None:
                with world.edit(Joint) as table:
                    for name, value in vars(made).items():
                        getattr(table, name)[world.row(entity)] = value
