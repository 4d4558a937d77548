"""Tracks, one file each; importing this package fills their registry."""

from carom.tools.recorder.track import TRACKS, Track
from carom.tools.recorder.tracks import (
    bodies,
    booked,
    cameras,
    contacts,
    detection,
    fast,
    happenings,
    impacts,
    milliseconds,
    normals,
    plots,
    residual,
    solver,
    substeps,
    sweeps,
)

__all__ = [
    "TRACKS",
    "Track",
    "bodies",
    "booked",
    "cameras",
    "contacts",
    "detection",
    "fast",
    "happenings",
    "impacts",
    "milliseconds",
    "normals",
    "plots",
    "residual",
    "solver",
    "substeps",
    "sweeps",
]
