"""A term: a value that can be asked of a world, and whose rows it is read from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from carom.ecs import Component, Entity, World
from carom.ecs.column import Floats, Integers

AXES = ("x", "y", "z", "w")
Read = Callable[[World], Floats]


class Place(NamedTuple):
    """A column, or one component of it."""

    kind: type[Component]
    name: str
    axis: int | None


@dataclass(frozen=True)
class Term:
    """A value of one or several entities; ``read`` returns it for each, shape (entities, size), in ``unit``.

    ``entities`` are whom its values are of, where each is of one; ``looks`` is whether it is asked of a picture;
    ``place`` is the column that it reads, where it reads one.
    """

    text: str
    unit: str
    size: int
    names: tuple[str, ...]
    read: Read
    entities: tuple[Entity, ...] = ()
    looks: bool = False
    place: Place | None = None


class Rows:
    """The rows of entities, looked up again only where rows may have changed."""

    def __init__(self, entities: list[Entity]) -> None:
        self._entities, self._seen = entities, (-1, -1)
        self._rows: Integers = np.zeros(0, np.int64)

    def __call__(self, world: World) -> Integers:
        """Return them as they are now; raise EntityError for one who is gone."""
        if self._seen != (world.structure, world.restored):
            self._rows = np.array([world.row(entity) for entity in self._entities], np.int64)
            self._seen = (world.structure, world.restored)
        return self._rows
