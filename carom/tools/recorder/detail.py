"""Detail: how much a recording holds, by the name of a level."""

from __future__ import annotations

from carom.ecs.errors import DeclarationError, did_you_mean
from carom.systems.extensions import load_extensions
from carom.tools.recorder.tracks import TRACKS, Track
from carom.worlds.sections import DETAILS


def tracks_of(detail: str) -> dict[str, Track]:
    """Return new tracks by their keys: those of all levels before one, then its own.

    Raises DeclarationError for a level that is none.
    """
    if detail not in DETAILS:
        accepted = f"accepted: {', '.join(DETAILS)}"
        parts = f"no detail is named {detail!r}", accepted, did_you_mean(detail, DETAILS)
        raise DeclarationError("; ".join(filter(None, parts)))
    load_extensions()
    levels = DETAILS[: DETAILS.index(detail) + 1]
    return {key: kind() for level in levels for key, kind in TRACKS.items() if kind.detail == level}
