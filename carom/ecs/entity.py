"""Entities: a row number and a generation in one integer, so that a stale handle is found out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NewType

if TYPE_CHECKING:
    from carom.ecs.world import World

Entity = NewType("Entity", int)

INDEX_BITS = 32
INDEX_MASK = (1 << INDEX_BITS) - 1


def pack(index: int, generation: int) -> Entity:
    """Return the handle of slot ``index`` in its ``generation``."""
    return Entity(generation << INDEX_BITS | index)


def index_of(entity: int) -> int:
    """Return the slot of a handle, without asking whether it still lives."""
    return entity & INDEX_MASK


def generation_of(entity: int) -> int:
    """Return the generation of a handle: how often its slot had been given back when it was made."""
    return entity >> INDEX_BITS


class EntityView:
    """One row read like an object: ``world[ball].motion.linear`` reads, assigning to it writes through."""

    __slots__ = ("_entity", "_world")

    def __init__(self, world: World, entity: Entity) -> None:
        object.__setattr__(self, "_world", world)
        object.__setattr__(self, "_entity", entity)

    def __getattr__(self, key: str) -> RecordView:
        world: World = object.__getattribute__(self, "_world")
        entity: Entity = object.__getattribute__(self, "_entity")
        return RecordView(world, entity, key)

    def __setattr__(self, key: str, value: Any) -> None:
        raise AttributeError(f"assign to a column: world[entity].{key}.<column> = value")


class RecordView:
    """One component of one entity; columns read as arrays or numbers and are written through on assignment."""

    __slots__ = ("_key", "_kind", "_row", "_world")

    def __init__(self, world: World, entity: Entity, key: str) -> None:
        kind, row = world.locate(entity, key)
        for name, value in (("_world", world), ("_kind", kind), ("_row", row), ("_key", key)):
            object.__setattr__(self, name, value)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._world[self._kind], self._checked(name))[self._row]

    def __setattr__(self, name: str, value: Any) -> None:
        with self._world.edit(self._kind) as table:
            getattr(table, self._checked(name))[self._row] = value

    def _checked(self, name: str) -> str:
        if name not in self._kind.columns:
            raise AttributeError(f"{self._kind.__name__} has no column '{name}', only {', '.join(self._kind.columns)}")
        return name
