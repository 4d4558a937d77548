"""Plots: the curves of a recording, those of one plot side by side."""

from __future__ import annotations

import numpy as np

from carom.ecs.dataframe import Flat, flat
from carom.tools.recorder.curves import Curves
from carom.tools.recorder.tracks import TRACKS
from carom.tools.recorder.tracks.plots import PATHS
from carom.tools.tables.source import Source

ROOT = "/plots/"
VALUES = "Scalars:scalars"
ABOUT = {f"/{path}": {"unit": quantity.unit, "doc": quantity.title} for path, quantity in PATHS.items()}


def plots(source: Source) -> dict[str, str]:
    """Return the path of each plot by its name: ``/plots/energy`` of ``energy``."""
    curves = [path for path, component in source.series if path.startswith(ROOT) and component == VALUES]
    names = dict.fromkeys(curve.removeprefix(ROOT).partition("/")[0] for curve in curves)
    return {name: f"{ROOT}{name}" for name in names}


def plot(source: Source, path: str) -> list[Flat]:
    """Return a row per frame, a column per curve; NaN in frames without a value, such as before an entry was booked."""
    track = TRACKS.get(path.removeprefix(ROOT))
    drawn = {"unit": track.unit, "doc": track.title} if track and issubclass(track, Curves) else ABOUT.get(path)
    about = drawn or {"unit": "1", "doc": path[1:]}
    curves = [at for at, component in source.series if at.startswith(f"{path}/") and component == VALUES]
    rows = {curve: source.rows(curve, {"value": VALUES}) for curve in curves}
    frames = np.unique(np.concatenate([row.frame for row in rows.values()]))
    columns = list(source.keys(frames))
    for curve, row in rows.items():
        values = np.full(len(frames), np.nan)
        values[np.searchsorted(frames, row.frame)] = row.columns["value"]
        columns.append(flat(curve.rpartition("/")[2], about, values))
    return columns
