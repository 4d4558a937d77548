"""Packed: what kernels read of a world's geometries, in flat arrays."""

from __future__ import annotations

from abc import ABC, abstractmethod
from copy import copy
from typing import ClassVar, Generic, Self, TypeVar

import numpy as np

from carom.ecs import Collider, World
from carom.ecs.column import Booleans
from carom.ecs.component import Resource
from carom.systems.kernels.packed import are_packed
from carom.systems.shapes.geometry import Geometries, Geometry
from carom.systems.shapes.shape import Shape

One = TypeVar("One")
Every = TypeVar("Every")


class Packed(Resource, ABC, Generic[One, Every]):
    """The geometries of colliders of these ``shapes``; a cache, packed anew when one of them has another geometry."""

    shapes: ClassVar[tuple[type[Shape], ...]]

    def __init__(self) -> None:
        self._numbers = np.array([shape.number for shape in self.shapes])
        self._made: dict[int, One] = {}
        self._known: Booleans = np.zeros(0, np.bool_)
        self._packed = self.pack(self._made)

    @abstractmethod
    def make(self, geometry: Geometry) -> One:
        """Return what is worked out once of a geometry."""

    @abstractmethod
    def pack(self, made: dict[int, One]) -> Every:
        """Return the arrays of all of them by number."""

    def forked(self) -> Self:
        """Return one that knows as much and learns by itself."""
        other = copy(self)
        other._made, other._known = dict(self._made), self._known.copy()
        return other

    def and_further(self, further: dict[int, Geometry]) -> Every:
        """Return the arrays of all that is packed and of further geometries, by numbers of their own."""
        return self.pack({**self._made, **{number: self.make(geometry) for number, geometry in further.items()}})

    def holding(self, world: World) -> Every:
        """Return the arrays, with the geometry of every collider of these shapes in them."""
        items = world[Geometries].items
        if not items:
            return self._packed
        if len(items) > len(self._known):
            self._known = np.append(self._known, np.zeros(len(items) - len(self._known), np.bool_))
        collider, rows = world[Collider], world.row_numbers(Collider)
        if are_packed(rows, collider.shape, collider.geometry, self._numbers, self._known):
            return self._packed
        shapes = collider.shape[rows]
        numbers = collider.geometry[rows[np.isin(shapes, self._numbers)]]
        for number in sorted(set(numbers[~self._known[numbers]].tolist())):
            self._made[number] = self.make(items[number])
        self._known[numbers] = True
        self._packed = self.pack(self._made)
        return self._packed
