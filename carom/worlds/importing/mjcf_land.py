"""Height fields of MJCF: a grey image over a rectangle, its darkest point at 0 and its brightest as high as stated."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from carom.ecs.errors import DeclarationError
from carom.systems.shapes.land import read_grey
from carom.worlds.importing.elements import Element, Reading


def land_words(element: Element, path: Path, reading: Reading) -> dict[str, Any] | None:
    """Return spacing along x and y, and the heights of black and white, of an ``<hfield>``; None for no image.

    Its first row is the farthest along y, which is carom's back. What is below it is solid, however thick its base.
    """
    half_x, half_y, height, _ = reading.numbers(element, "size", 4)
    try:
        values = read_grey(path)
    except DeclarationError as fault:
        reading.fault(element, str(fault))
        return None
    rows, columns = values.shape
    darkest, range_of = float(values.min()), float(values.max() - values.min())
    if min(rows, columns) < 2 or range_of == 0.0:
        return None
    spacing = (2.0 * half_x / (columns - 1), 2.0 * half_y / (rows - 1))
    low = -height * darkest / range_of
    return {"spacing": spacing, "low": low, "high": low + height / range_of}
