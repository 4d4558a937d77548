"""Snapshots: at which frames the whole state is kept, and its hash there."""

from __future__ import annotations

import numpy as np
import pyarrow

from carom.ecs.dataframe import Flat, flat
from carom.tools.recorder.snapshots import PATH
from carom.tools.tables.source import Source


def snapshots(source: Source) -> list[Flat]:
    """Return a row per snapshot, without the state itself."""
    series = source.series.get((f"/{PATH}", "hash"))
    frames = np.array(series.frames if series else [], np.int64)
    hashes = [value[0] for value in series.values] if series else []
    about = {"unit": "1", "doc": "hash of the whole state"}
    return [*source.keys(frames), flat("hash", about, pyarrow.array(hashes, pyarrow.string()))]
