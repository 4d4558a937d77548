"""Sheet: pictures of one run side by side, each with its time under it, as photographers' contact sheets."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from carom.systems.simulation import Simulation
from carom.tools.film import Picture, save_png
from carom.tools.filming import Photographing, Shot

GAP, CAPTION = 8, 26  # px between pictures, and for the time under each
PAPER, INK = (250, 250, 248), (40, 40, 44)
SHAPE = 4.0 / 3.0  # width over height that a sheet is to have


class Sheet(Photographing):
    """Photographs a simulation at ``times`` (s), in order, and puts the pictures on one sheet (PNG)."""

    def __init__(self, shot: Shot, path: Path, times: Sequence[float]) -> None:
        super().__init__(shot, times)
        self._path, self._captions = path, captions(times)
        self._pictures: list[Picture] = []

    def take(self, picture: Picture) -> None:
        """Keep the picture."""
        self._pictures.append(picture)

    def end(self, simulation: Simulation) -> None:
        """Write the sheet of the pictures taken."""
        super().end(simulation)
        if self._pictures:
            save_png(self._path, contact_sheet(self._pictures, self._captions[: len(self._pictures)]))


def spread(start: float, end: float, count: int) -> list[float]:
    """Return as many times (s) evenly from ``start`` to ``end``, both of them shown where there are two or more."""
    return [float(time) for time in np.linspace(start, end, count)]


def captions(times: Sequence[float]) -> list[str]:
    """Return times (s) as texts: hundredths where that is exact, else thousandths, or what tells them apart."""
    exact = np.allclose(times, np.round(times, 2), rtol=0.0, atol=1e-6)
    gap = max(float(np.diff(times).min(initial=1.0)), 1e-9)
    digits = 2 if exact else max(3, 1 - math.floor(math.log10(gap)))
    return [f"{time:.{digits}f} s" for time in times]


def columns_for(count: int, width: int, height: int) -> int:
    """Return in how many columns as many cells (px) make a sheet of about 4:3 with few of them empty."""

    def odd(columns: int) -> float:
        rows = -(-count // columns)
        return abs(math.log(columns * width / (rows * height) / SHAPE)) + 1.0 - count / (columns * rows)

    return min(range(1, count + 1), key=odd)


def contact_sheet(pictures: Sequence[Picture], texts: Sequence[str]) -> Picture:
    """Return pictures of one size (height, width, 3) in rows of a sheet, with a text under each."""
    from PIL import Image, ImageDraw, ImageFont

    height, width = pictures[0].shape[:2]
    across, down = width + GAP, height + CAPTION + GAP
    columns = columns_for(len(pictures), across, down)
    rows = -(-len(pictures) // columns)
    sheet = Image.new("RGB", (columns * across + GAP, rows * down + GAP), PAPER)
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default(0.6 * CAPTION)
    for number, (picture, text) in enumerate(zip(pictures, texts, strict=True)):
        left, top = GAP + number % columns * across, GAP + number // columns * down
        sheet.paste(Image.fromarray(picture), (left, top))
        draw.text((left + width / 2, top + height + CAPTION / 2), text, INK, font, anchor="mm")
    return np.asarray(sheet)
