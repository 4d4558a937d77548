"""Entities: an id and its generation in one integer, so that a stale handle is found out; and one row as an object."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NewType, TypeVar

import numpy as np

from carom.ecs.components.name import Name
from carom.ecs.describe import describe, describe_component
from carom.ecs.display import entity_html

if TYPE_CHECKING:
    from carom.ecs.component import Component
    from carom.ecs.world import World

Entity = NewType("Entity", int)
C = TypeVar("C", bound="Component")

INDEX_BITS = 32
INDEX_MASK = (1 << INDEX_BITS) - 1


class EntityView:
    """One row read like an object: ``world[ball].motion.linear`` reads, assigning to it writes through."""

    __slots__ = ("_world", "entity")

    entity: Entity

    def __init__(self, world: World, entity: Entity) -> None:
        object.__setattr__(self, "_world", world)
        object.__setattr__(self, "entity", entity)

    def __getattr__(self, key: str) -> RecordView:
        if key.startswith("_"):  # asked for by Python and notebooks
            raise AttributeError(key)
        world: World = object.__getattribute__(self, "_world")
        return RecordView(world, self.entity, key)

    def __getitem__(self, kind: type[C]) -> C:
        """Return the component of this class, for those who prefer classes to names: ``world[ball][Motion].linear``."""
        world: World = object.__getattribute__(self, "_world")
        return RecordView(world, self.entity, kind.key)  # type: ignore[return-value]

    def __contains__(self, kind: type[Component]) -> bool:
        world: World = object.__getattribute__(self, "_world")
        return kind in world.components(self.entity)

    def __setattr__(self, key: str, value: Any) -> None:
        raise AttributeError(f"assign to a column: world[entity].{key}.<column> = value")

    def __dir__(self) -> list[str]:
        world: World = object.__getattribute__(self, "_world")
        return [*super().__dir__(), *(kind.key for kind in world.components(self.entity))]

    def __repr__(self) -> str:
        world: World = object.__getattribute__(self, "_world")
        return describe(world, self.entity) if self.entity in world else world.slots.fate(self.entity)

    def _repr_html_(self) -> str | None:
        world: World = object.__getattribute__(self, "_world")
        return entity_html(world, self.entity) if self.entity in world else None


class RecordView:
    """One component of one entity; columns read as arrays or numbers and are written through on assignment."""

    __slots__ = ("_entity", "_kind", "_world")

    def __init__(self, world: World, entity: Entity, key: str) -> None:
        kind, _ = world.locate(entity, key)
        for name, value in (("_world", world), ("_kind", kind), ("_entity", entity)):
            object.__setattr__(self, name, value)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        value = getattr(self._world[self._kind], self._checked(name))[self._world.row(self._entity)]
        if not isinstance(value, np.ndarray):
            return value
        shown = value.view(Value)
        shown.write = lambda key, new: self._write(name, key, new)
        return shown

    def __setattr__(self, name: str, value: Any) -> None:
        self._write(self._checked(name), ..., value)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._kind.columns]

    def __repr__(self) -> str:
        return describe_component(self._world, self._entity, self._kind)

    def _write(self, name: str, key: Any, value: Any) -> None:
        column, where = self._kind.columns[name], f"{self._kind.__name__}.{name}"
        accepted = column.accept(value, where)
        if key is ...:
            column.fit(accepted, 1, where)
        row = self._world.row(self._entity)
        if self._kind is Name:
            self._world.names_now().refuse_taken([str(accepted)], self._entity)
        with self._world.edit(self._kind) as table:
            array = getattr(table, name)
            if key is ...:
                array[row] = accepted
            else:
                array[row][key] = accepted

    def _checked(self, name: str) -> str:
        if name not in self._kind.columns:
            listed = ", ".join(self._kind.columns) or "none at all"
            raise AttributeError(f"{self._kind.__name__} has no column '{name}', only {listed}")
        return name


class Value(np.ndarray):
    """The value of one entity in one column: assigning to its elements, and ``+=``, write through to the table.

    So it is also of a value kept under a name, as long as no spawn makes the table grow.
    """

    write: Callable[[Any, Any], None] | None = None

    def __setitem__(self, key: Any, value: Any) -> None:
        if self.write is None:  # what was computed from a value is an array like any other
            super().__setitem__(key, value)
        else:
            self.write(key, value)


def _in_place(operator: str) -> Callable[[Value, Any], Any]:
    """Return ``+=`` as ``+`` followed by writing through; of part of a value, as the caller assigns that part."""

    def apply(self: Value, other: Any) -> Any:
        result = getattr(np.ndarray, operator)(np.asarray(self), other)
        if self.write is None:
            return result
        self.write(..., result)
        return self

    return apply


for _name in ("add", "sub", "mul", "truediv", "floordiv", "mod", "pow"):
    setattr(Value, f"__i{_name}__", _in_place(f"__{_name}__"))
