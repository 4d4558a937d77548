"""Components and relations: classes whose annotated columns declare a table, and whose instances hold the arrays."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, ClassVar, Self

from carom.ecs.column import Column
from carom.ecs.dataframe import Dataframe, relation_table
from carom.ecs.describe import describe_bundle, describe_table
from carom.ecs.display import query_html, relation_html
from carom.ecs.errors import DeclarationError, SnapshotError

if TYPE_CHECKING:
    from pyarrow import Table

    from carom.ecs.world import World


class Record(Dataframe):
    """A set of columns under one name; see `Component` and `Relation`."""

    columns: ClassVar[dict[str, Column]] = {}
    key: ClassVar[str] = ""
    registry: ClassVar[dict[str, type[Record]]] = {}
    kept: ClassVar[bool] = False  # a derived kind that is a result: observers read it although no system does
    _world: World | None = None  # the one whose table this is; None for a bundle

    def __init_subclass__(cls, *, key: str = "", **options: Any) -> None:
        super().__init_subclass__(**options)
        own = {name: value for name, value in vars(cls).items() if isinstance(value, Column)}
        for name in own:
            delattr(cls, name)
        cls.columns = cls.columns | own
        cls.key = key or re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", cls.__name__).lower()
        if cls.__module__ == __name__:
            return
        known = Record.registry.get(cls.key)
        if known is not None and known.__module__ != cls.__module__:
            raise DeclarationError(
                f"two components are named {cls.__name__}: {known.__module__} and {cls.__module__}; rename one of them"
            )
        Record.registry[cls.key] = cls

    def __init__(self, **values: Any) -> None:
        """Hold ``values`` (column name to value, or to one value per row) as a bundle for `World.spawn`."""
        for name, value in values.items():
            if name not in self.columns:
                raise DeclarationError(
                    f"{type(self).__name__} has no column '{name}'; its columns are {', '.join(self.columns)}"
                )
            setattr(self, name, self.columns[name].accept(value, f"{type(self).__name__}.{name}"))

    @classmethod
    def derived(cls) -> bool:
        """Tell whether every column is rewritten by the step, so that no file or snapshot supplies it."""
        return bool(cls.columns) and all(column.role in ("derived", "cache") for column in cls.columns.values())

    @classmethod
    def blank(cls) -> Self:
        """Return an instance without arrays, to be filled by its table."""
        return cls.__new__(cls)

    def __repr__(self) -> str:
        return describe_bundle(self) if self._world is None else describe_table(self._world, type(self))

    def _home(self) -> World:
        if self._world is None:
            name = type(self).__name__
            raise DeclarationError(f"{name}(...) is a bundle for spawn, not a table; write world[{name}]")
        return self._world


class Component(Record):
    """Columns over entities: row *i* of every component of a world is the same entity."""

    def arrow(self) -> Table:
        """Return the entities that have it; see `Dataframe.arrow`."""
        return self._home().query(type(self)).arrow()

    def _repr_html_(self) -> str | None:
        return None if self._world is None else query_html(self._world.query(type(self)))


class Relation(Record):
    """Columns over rows of their own (contacts, events, springs): a table beside the entities with a row count."""

    count: int = 0

    def arrow(self) -> Table:
        """Return its rows; see `Dataframe.arrow`."""
        return relation_table(self._home(), type(self))

    def _repr_html_(self) -> str | None:
        return None if self._world is None else relation_html(self._world, type(self))


class Resource:
    """A per-world singleton, reached as ``world[Kind]`` like a table."""

    def state(self) -> bytes | None:
        """Return what a snapshot must keep of this resource, or None for settings and caches."""
        return None

    def restore(self, state: bytes) -> None:
        """Take back what `state` returned."""
        raise SnapshotError(f"{type(self).__name__} saves state but does not restore it")
