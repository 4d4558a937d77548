"""Impacts: who struck whom, where and how hard."""

from __future__ import annotations

import numpy as np

from carom.ecs.dataframe import Flat, flat
from carom.ecs.relations.impact import Impact
from carom.tools.recorder.tracks.impacts import NUMBERS, PATH, VECTORS
from carom.tools.tables.source import Source, flats


def impacts(source: Source) -> list[Flat]:
    """Return a row per impact of any step, at its own time inside the step."""
    kinds = {name: Impact.columns[name] for name in (*NUMBERS, *VECTORS)}
    if (f"/{PATH}", "time") in source.series:
        frames, values = source.rows(f"/{PATH}", {name: name for name in kinds})
    else:
        frames = np.zeros(0, np.int64)
        values = {name: np.zeros((0, *kind.shape), kind.dtype) for name, kind in kinds.items()}
    columns = [flat("frame", {"unit": "1", "doc": "number of the step"}, frames)]
    for name, kind in kinds.items():
        if kind.holds == "entities":
            columns += source.entities(name, f"{name}.name", kind.doc, values[name])
        else:
            columns += flats(name, kind, values[name])
    return columns
