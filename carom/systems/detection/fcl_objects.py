"""FCL's objects of a world's colliders, kept from step to step: making one takes as long as a collision."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs import Collider, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.components.collider import SHAPE_PARAMETERS
from carom.systems.compound import shape_at


class FclObjects(Resource):
    """Two collision objects for every form of collider: one that stays at the origin, and one to be moved; a cache."""

    def __init__(self) -> None:
        self.forms: dict[tuple[float, ...], int] = {}
        self.geometries: list[Any] = []
        self.staying: list[Any] = []
        self.moving: list[Any] = []
        self.form_of: Integers = np.zeros(0, np.int64)
        self.stated: Floats = np.zeros((0, 2 + SHAPE_PARAMETERS))

    def forms_of(self, world: World, rows: Integers) -> Integers:
        """Return the number of each collider's form; those that differ from what they were are looked up anew."""
        if len(self.form_of) < world.capacity:
            self.form_of = np.zeros(world.capacity, np.int64)
            self.stated = np.full((world.capacity, 2 + SHAPE_PARAMETERS), np.nan)
        collider = world[Collider]
        stated = np.empty((len(rows), 2 + SHAPE_PARAMETERS))
        stated[:, 0], stated[:, 1], stated[:, 2:] = collider.shape[rows], collider.geometry[rows], collider.size[rows]
        for k in np.nonzero((stated != self.stated[rows]).any(axis=1))[0].tolist():
            row = int(rows[k])
            self.form_of[row] = self._form(world, row, tuple(stated[k].tolist()))
            self.stated[row] = stated[k]
        found: Integers = self.form_of[rows]
        return found

    def geometry_of(self, world: World, row: int) -> Any:
        """Return FCL's geometry of a collider."""
        return self.geometries[self.forms_of(world, np.array([row]))[0]]

    def _form(self, world: World, row: int, key: tuple[float, ...]) -> int:
        import fcl

        if key not in self.forms:
            geometry = shape_at(world, row).fcl_geometry()
            self.forms[key] = len(self.geometries)
            self.geometries.append(geometry)
            self.staying.append(fcl.CollisionObject(geometry))
            self.moving.append(fcl.CollisionObject(geometry))
        return self.forms[key]
