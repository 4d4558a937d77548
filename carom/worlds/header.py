"""The header of a world file: which version of the format it is written in."""

from __future__ import annotations

from typing import Any

from carom import __version__
from carom.worlds.errors import Fault, WorldError, shown
from carom.worlds.source import Source

VERSION = 1


def with_header(source: Source) -> dict[str, Any]:
    """Return the data of a world of this version; raise WorldError at once for others, since nothing else counts."""
    data, accepted = source.data, f"'carom: {VERSION}' as its first line"
    if not isinstance(data, dict):
        raise WorldError([*source.faults, Fault(source.name, 1, 1, "", "is no world", shown(data), accepted)])
    if "carom" not in data:
        raise WorldError([*source.faults, Fault(source.name, 1, 1, "carom", "is missing", accepted=accepted)])
    if data["carom"] != VERSION or isinstance(data["carom"], bool):
        place, received = source.position(("carom",)), shown(data["carom"])
        later = isinstance(data["carom"], (int, float)) and data["carom"] > VERSION
        hint = f"install a later carom to read it, this is {__version__}" if later else ""
        fault = Fault(source.name, *place, "carom", "unknown version", received, str(VERSION), hint)
        raise WorldError([*source.faults, fault])
    return data
