"""Log: what happened, line by line."""

from __future__ import annotations

import numpy as np
import pyarrow

from carom.ecs.dataframe import Flat, flat
from carom.tools.tables.source import FRAME, Source


def log(source: Source) -> list[Flat]:
    """Return a row per line, at its own time inside the step."""
    lines = source.lines
    return [
        flat("frame", FRAME, np.array([line.frame for line in lines], np.int64)),
        flat("time", {"unit": "s", "doc": "simulated time"}, np.array([line.time for line in lines], np.float64)),
        flat("level", {"unit": "1", "doc": "DEBUG or INFO"}, _texts([line.level for line in lines])),
        flat("text", {"unit": "1", "doc": "what happened"}, _texts([line.text for line in lines])),
    ]


def _texts(texts: list[str]) -> pyarrow.Array:
    return pyarrow.array(texts, pyarrow.string())
