"""Tables: what a recording holds as dataframes, keyed by frame and entity."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from carom.ecs.dataframe import Flat
from carom.tools.recorder.rows import RowTrack
from carom.tools.recorder.tracks import TRACKS
from carom.tools.tables.bodies import bodies
from carom.tools.tables.log import log
from carom.tools.tables.plots import plot, plots
from carom.tools.tables.recorded import is_there, recorded
from carom.tools.tables.snapshots import snapshots
from carom.tools.tables.source import Source
from carom.tools.tables.substeps import substeps


def makers(source: Source) -> dict[str, Callable[[], list[Flat]]]:
    """Return what makes the columns of each table of a recording, by the table's name."""
    found: dict[str, Callable[[], list[Flat]]] = {"bodies": partial(bodies, source)}
    if source.substeps:
        found["substeps"] = partial(substeps, source.substeps, source.substep_count)
    tracks = {key: track for key, track in TRACKS.items() if issubclass(track, RowTrack) and is_there(source, track)}
    found |= {key: partial(recorded, source, track) for key, track in tracks.items()}
    found |= {name: partial(plot, source, path) for name, path in plots(source).items()}
    return found | {"log": partial(log, source), "snapshots": partial(snapshots, source)}
