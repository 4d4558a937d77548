"""Source: the rows of a recording, and the columns that several tables have."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Column, Integers
from carom.ecs.dataframe import Dataframe, Flat, flat, paths, table_of

if TYPE_CHECKING:
    from pyarrow import Table

    from carom.tools.reading import Line, Series

FRAME = {"unit": "1", "doc": "number of the step"}


class Rows(NamedTuple):
    """Frame, and what else is there of each row."""

    frame: Integers
    columns: dict[str, npt.NDArray[Any]]


@dataclass(frozen=True)
class Source:
    """The rows of every path and component, the recorded frames, the time (s) of each, and the log.

    ``substeps`` are poses by their number instead of that of a frame, which has ``substep_count`` of them.
    """

    series: Mapping[tuple[str, str], Series]
    frames: Sequence[int]
    times: Mapping[int, float]
    lines: Sequence[Line]
    substeps: Source | None = None
    substep_count: int = 0

    @cached_property
    def names(self) -> dict[int, str]:
        """The name of every entity that was visible or could be touched, by handle."""
        found: dict[int, str] = {}
        for (path, component), series in self.series.items():
            if component in ("entity", "collider") and (names := self.series.get((path, "name"))):
                for entities, called in zip(series.values, names.values, strict=True):
                    found |= dict(zip(entities.tolist(), called, strict=True))
        return found

    def rows(self, path: str, components: Mapping[str, str]) -> Rows:
        """Return all rows of a path, one per instance, with those components that it has, by their names."""
        held = {name: at for name, component in components.items() if (at := self.series.get((path, component)))}
        count = min(len(series.frames) for series in held.values())  # killed between two writes
        first = next(iter(held.values()))
        frames = np.repeat(np.array(first.frames[:count], np.int64), [len(value) for value in first.values[:count]])
        return Rows(frames, {name: np.concatenate(series.values[:count]) for name, series in held.items()})

    def keys(self, frames: Integers) -> Iterator[Flat]:
        """Return the columns that tell when a row is."""
        different, place = np.unique(frames, return_inverse=True)
        times = np.array([self.times[frame] for frame in different.tolist()], np.float64)
        yield flat("frame", FRAME, frames)
        yield flat("time", {"unit": "s", "doc": "simulated time"}, times[place])

    def entities(self, path: str, name: str, doc: str, handles: Integers) -> Iterator[Flat]:
        """Return the columns of a handle and of the name to it."""
        import pyarrow

        different, place = np.unique(handles, return_inverse=True)
        called = pyarrow.array([self.names.get(handle) for handle in different.tolist()], pyarrow.string())
        yield flat(path, {"unit": "1", "doc": doc}, handles)
        yield flat(name, {"unit": "1", "doc": "name"}, called.take(pyarrow.array(place)))


def flats(name: str, column: Column, values: npt.NDArray[Any]) -> Iterator[Flat]:
    """Return the columns of what a component or relation declares, one per number."""
    about = {"unit": column.unit, "doc": column.doc}
    split = values.reshape(len(values), math.prod(column.shape)).T
    for path, numbers in zip(paths(name, column), split, strict=True):
        yield flat(path, about, np.ascontiguousarray(numbers))


class RecordedTable(Dataframe):
    """A table of a recording: a row per frame, and per entity or contact where there are several in one."""

    def __init__(self, columns: list[Flat]) -> None:
        self._arrow = table_of(columns)

    def arrow(self) -> Table:
        """Return a `pyarrow.Table` whose fields carry ``unit`` and ``doc`` as metadata."""
        return self._arrow
