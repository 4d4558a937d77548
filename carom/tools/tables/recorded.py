"""Recorded: the table of a track that records rows."""

from __future__ import annotations

import numpy as np

from carom.ecs.dataframe import Flat, flat
from carom.tools.recorder.rows import RowTrack
from carom.tools.tables.source import Source, flats


def is_there(source: Source, track: type[RowTrack]) -> bool:
    """Tell whether a recording has a track, if only to say that there was nothing."""
    return (track.detail == "light" and not track.sparse) or any(
        (f"/{track.path}", name) in source.series for name in track.columns
    )


def recorded(source: Source, track: type[RowTrack]) -> list[Flat]:
    """Return a row per row of the track, at the frame's time unless it has its own."""
    path, names = f"/{track.path}", {name: track.drawn.get(name, name) for name in track.columns}
    if any((path, name) in source.series for name in names.values()):
        frames, values = source.rows(path, names)
    else:
        frames = np.zeros(0, np.int64)
        values = {name: np.zeros((0, *column.shape), column.dtype) for name, column in track.columns.items()}
    keys = source.keys(frames)
    columns = [next(keys)] if "time" in track.columns else list(keys)
    for name, held in values.items():
        column = track.columns[name]
        about = {"unit": column.unit, "doc": column.doc}
        if column.holds == "entities":
            columns += source.entities(name, f"{name}.name", column.doc, held)
        elif column.dtype.kind == "U":
            columns.append(flat(name, about, held.astype(np.str_)))
        else:
            columns += flats(name, column, held)
    return columns
