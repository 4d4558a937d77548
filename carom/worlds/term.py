"""A term: a value that can be asked of a world, and of whom it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from carom.ecs import Component, World
from carom.ecs.column import Booleans, Floats
from carom.worlds.cast import Cast

AXES = ("x", "y", "z", "w")
Read = Callable[[World], Floats]
ALWAYS: Booleans = np.ones(1, np.bool_)


class Place(NamedTuple):
    """A column, or one component of it."""

    kind: type[Component]
    name: str
    axis: int | None


@dataclass(frozen=True)
class Term:
    """A value of one or several entities; ``read`` returns it for each, shape (entities, size), in ``unit``.

    ``cast`` is whom it is of, and ``there`` tells which of its values there are to be read now, where that is not
    always so; ``looks`` is whether it is asked of a picture; ``place`` is the column that it reads, where it reads one.
    """

    text: str
    unit: str
    size: int
    names: tuple[str, ...]
    read: Read
    cast: Cast | None = None
    there: Callable[[World], Booleans] = lambda world: ALWAYS
    looks: bool = False
    place: Place | None = None

    def of(self, index: int) -> str:
        """Return of whom one of its values is; nothing where it is of several."""
        return self.cast.names[index] if self.cast is not None and len(self.cast.names) == len(self.names) else ""

    def absence(self, world: World, index: int | None = None) -> str:
        """Say who of all of whom it is, or of whom one of its values is, is not there."""
        if self.cast is None:
            return ""
        return self.cast.absence(world, index if len(self.cast.names) == len(self.names) else None)
