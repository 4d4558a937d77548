"""What tests of refused worlds share."""

from __future__ import annotations

from pathlib import Path

import pytest

from carom.worlds import WorldError, load_text

LENGTH = "a number in m, or one with a unit: m, mm, cm, km, um, in, ft, mi"


def refusal(text: str, folder: Path | None = None) -> str:
    """Return what a world is refused with; the header is added as line 1."""
    with pytest.raises(WorldError) as caught:
        load_text("carom: 1\n" + text, "w.yaml", folder)
    return str(caught.value)


def messages(text: str, folder: Path | None = None) -> list[str]:
    """Return the lines of that."""
    return refusal(text, folder).split("\n")
