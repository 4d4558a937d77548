"""Dataframes: queries and tables as flat columns, for Arrow, pandas, polars and whatever else speaks Arrow."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.ecs.column import Booleans, Column, Integers

if TYPE_CHECKING:
    from pyarrow import Table

    from carom.ecs.component import Component, Record
    from carom.ecs.query import Query
    from carom.ecs.slots import Rows
    from carom.ecs.world import World

AXES = "xyzw"
Flat = tuple[Any, Any]  # an Arrow field with its unit and meaning, and its array


class Dataframe(ABC):
    """What can be had as a flat table: a row per entity, or per row of a relation, and a column per number.

    Columns are called by the paths of world files, such as ``transform.position.x``; those of a relation by their own
    names. Values are copied, so that later steps do not reach them. ``polars.DataFrame(query)``,
    ``pyarrow.table(world[Contact])`` and all others that take Arrow streams work as well.
    """

    @abstractmethod
    def arrow(self) -> Table:
        """Return a `pyarrow.Table` whose fields carry ``unit`` and ``doc`` as metadata."""

    def pandas(self) -> Any:
        """Return a `pandas.DataFrame`; raise ModuleNotFoundError, saying how to install it, where there is none."""
        pandas, table = _installed("pandas"), self.arrow()
        frame = table.to_pandas()
        for name, column in zip(table.column_names, table.columns, strict=True):
            if column.null_count and str(column.type) not in ("float", "double", "string"):
                frame[name] = column.to_pandas(types_mapper=pandas.ArrowDtype)  # a gap must not turn handles to floats
        return frame

    def polars(self) -> Any:
        """Return a `polars.DataFrame`; raise ModuleNotFoundError, saying how to install it, where there is none."""
        return _installed("polars").DataFrame(self.arrow())

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        """Return the same as a stream, as the Arrow PyCapsule protocol wants it."""
        return self.arrow().__arrow_c_stream__(requested_schema)


def query_table(query: Query) -> Table:
    """Return the entities of a query: handle, name, its components, and those optional ones an entity has or not."""
    world, rows = query.world, query.rows
    columns = list(_entities(world, "entity", "name", {"unit": "1", "doc": "handle"}, world.entities(rows), None))
    for kind in dict.fromkeys((*query.kinds, *query.optional)):
        held = query.has(kind)
        if not kind.columns:
            columns.append(flat(kind.key, {"unit": "1", "doc": _first_line(kind)}, held, None))
        elif kind.key != "name":  # which is there already
            columns += _columns(world, kind, kind.key + ".", rows, None if held.all() else ~held)
    return table_of(columns)


def relation_table(world: World, kind: type[Record]) -> Table:
    """Return the rows of a relation; a column that holds entities is followed by their names."""
    return table_of(_columns(world, kind, "", slice(0, world.count(kind)), None))


def paths(path: str, column: Column) -> list[str]:
    """Return what each number of a row is called: by x, y, z and w, where there are more by numbers."""
    if len(column.shape) == 1 and column.shape[0] <= len(AXES):
        return [f"{path}.{axis}" for axis in AXES[: column.shape[0]]]
    return [".".join([path, *map(str, index)]) for index in np.ndindex(column.shape)]


def _columns(world: World, kind: type[Record], start: str, rows: Rows, missing: Booleans | None) -> Iterator[Flat]:
    for name, column in kind.columns.items():
        values = world.table(kind).arrays[name][rows]
        split = np.array(values.reshape(len(values), math.prod(column.shape)).T, order="C")  # a copy
        about = {"unit": column.unit, "doc": column.doc}
        for path, numbers in zip(paths(start + name, column), split, strict=True):
            if column.holds == "entities":
                yield from _entities(world, path, f"{path}.name", about, numbers, missing)
            else:
                yield flat(path, about, numbers, missing)


def _entities(
    world: World, path: str, name: str, about: dict[str, str], handles: Integers, missing: Booleans | None
) -> Iterator[Flat]:
    names = world.names_of(handles if missing is None else np.where(missing, -1, handles))  # a gap holds 0, a handle
    yield flat(path, about, handles, missing)
    yield flat(name, {"unit": "1", "doc": "name, where it has one"}, names, names == "")


def flat(path: str, about: dict[str, str], values: Any, missing: Booleans | None = None) -> Flat:
    """Return a column (n,) of an array or of an Arrow array, with its unit and meaning; those missing are empty."""
    import pyarrow  # 0.1 s, so only where it is needed

    if isinstance(values, pyarrow.Array):
        array = values
    elif values.dtype.kind == "U":
        array = pyarrow.array(values.tolist(), pyarrow.string(), mask=missing)  # 30 times faster than from the array
    else:
        array = pyarrow.array(values, mask=missing)
    return pyarrow.field(path, array.type, metadata=about), array


def table_of(columns: Iterator[Flat] | list[Flat]) -> Table:
    """Return a table of flat columns."""
    import pyarrow

    fields, arrays = zip(*columns, strict=True)
    return pyarrow.Table.from_arrays(list(arrays), schema=pyarrow.schema(fields))


def _first_line(kind: type[Component]) -> str:
    return (kind.__doc__ or "").strip().split("\n")[0]


def _installed(package: str) -> Any:
    try:
        return import_module(package)
    except ModuleNotFoundError as fault:
        if fault.name != package:
            raise
        raise ModuleNotFoundError(f"{package} is not installed; pip install {package}", name=package) from None
