"""Questions to a picture: how much of an entity is seen, where on the screen it is, and who is in front of it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs import Visual, World
from carom.ecs.column import Booleans, Integers
from carom.ecs.errors import CaromError
from carom.systems.compound import bodies_of
from carom.systems.simulation import Simulation
from carom.tools.filming import Shot

Entity = int | str  # a handle or a unique name


class Box(NamedTuple):
    """A rectangle of a picture, px from its corner on top and left, ``right`` and ``bottom`` just outside."""

    left: int
    top: int
    right: int
    bottom: int


class Sight:
    """What a shot shows of a simulation, asked entity by entity; each answer is drawn anew, as the world is now.

    An entity is all that is drawn of it, a body with all its parts. A pixel belongs to what its centre shows, and what
    is translucent hides nothing. Close it when done, or use it in a ``with`` statement.
    """

    def __init__(self, simulation: Simulation, shot: Shot) -> None:
        from carom.tools.renderer import Renderer
        from carom.tools.scene import Scene

        self._world, self._shot = simulation.world, shot
        self._scene = Scene(self._world)
        self._renderer = Renderer(shot.width, shot.height)

    def visible(self, entity: Entity) -> int:
        """Return how many pixels show the entity."""
        return int(self._seen(entity).sum())

    def silhouette(self, entity: Entity) -> Booleans:
        """Return which pixels (height, width) would show the entity if there were nothing else."""
        rows = self._rows(entity)
        return np.isin(self._ids(rows, alone=True), rows)

    def visible_share(self, entity: Entity) -> float:
        """Return how much of the entity's silhouette is visible, 0 to 1; 0 too where none of it is on the picture."""
        whole = int(self.silhouette(entity).sum())
        return self.visible(entity) / whole if whole else 0.0

    def box(self, entity: Entity) -> Box | None:
        """Return the smallest rectangle around the entity's silhouette, None where none of it is on the picture."""
        down, across = np.nonzero(self.silhouette(entity))
        if not len(down):
            return None
        return Box(int(across.min()), int(down.min()), int(across.max()) + 1, int(down.max()) + 1)

    def occluders(self, entity: Entity) -> dict[str, int]:
        """Return who is in front of the entity, by name, each with the pixels of its silhouette that it hides."""
        rows = self._rows(entity)
        shown = self._ids(rows)[self.silhouette(entity)]
        hiding, counts = np.unique(_owners(self._world)[shown[~np.isin(shown, rows)]], return_counts=True)
        names = [self._world.name(self._world.entity(row)) for row in hiding.tolist()]
        return dict(sorted(zip(names, counts.tolist(), strict=True), key=lambda one: -one[1]))

    def overlap(self, one: Entity, other: Entity) -> int:
        """Return in how many pixels the silhouettes of two entities lie over each other, whichever is in front."""
        return int((self.silhouette(one) & self.silhouette(other)).sum())

    def left_of(self, one: Entity, other: Entity) -> bool:
        """Tell whether the middle of the box of one is left of that of the other; no where one has none."""
        first, second = self.box(one), self.box(other)
        return bool(first and second and first.left + first.right < second.left + second.right)

    def above(self, one: Entity, other: Entity) -> bool:
        """Tell whether the middle of the box of one is higher than that of the other; no where one has none."""
        first, second = self.box(one), self.box(other)
        return bool(first and second and first.top + first.bottom < second.top + second.bottom)

    def close(self) -> None:
        """Free what was drawn with."""
        self._renderer.close()

    def __enter__(self) -> Sight:
        return self

    def __exit__(self, *fault: object) -> None:
        self.close()

    def _seen(self, entity: Entity) -> Booleans:
        rows = self._rows(entity)
        return np.isin(self._ids(rows), rows)

    def _rows(self, entity: Entity) -> Integers:
        handle = self._world.find(entity) if isinstance(entity, str) else entity
        found = drawn_rows(self._world, handle)
        if not len(found):
            name = self._world.name(handle)
            raise CaromError(f"sight: nothing is drawn of '{name}'; give it a collider or a visual")
        return found

    def _ids(self, rows: Integers, *, alone: bool = False) -> Integers:
        """Return the row that each pixel shows, -1 for none, of what is drawn in ``rows`` and all that hides."""
        batches = []
        for batch in self._scene.batches():
            wanted = np.isin(batch.ids, rows)
            batches.append(batch.take(np.nonzero(wanted if alone else wanted | (batch.colors[:, 3] >= 1.0))[0]))
        seen: Integers = self._renderer.ids(batches, self._shot.camera(self._world))
        return seen


def drawn_rows(world: World, entity: int) -> Integers:
    """Return the rows of an entity and of its parts of which something can be drawn."""
    row = world.row(entity)
    rows = world.row_numbers(Visual)
    return np.asarray(rows[(rows == row) | (bodies_of(world)[rows] == row)], np.int64)


def _owners(world: World) -> Integers:
    bodies = bodies_of(world)
    owners: Integers = np.where(bodies >= 0, bodies, np.arange(len(bodies)))
    return owners
