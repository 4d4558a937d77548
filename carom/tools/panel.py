"""Panel: a dark pane to write and draw on, put into a picture as an inset."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.tools.strokes import draw_strokes

HEIGHT_PER_TEXT = 36  # a text is this part of the picture's height, but
SMALLEST = 12  # px at least
LEADING = 1.35  # from line to line over the height of a text
DARK = (16, 20, 26)
PANEL_ALPHA = 165
CURVE = 1.6  # px wide

Picture = npt.NDArray[np.uint8]


@cache
def font(size: int) -> Any:
    """Return Pillow's own font, ``size`` px high."""
    from PIL import ImageFont

    return ImageFont.load_default(size)


def text_size(height: int) -> int:
    """Return how high texts are (px) in a picture of this height."""
    return max(SMALLEST, height // HEIGHT_PER_TEXT)


@lru_cache(1000)
def width_of(text: str, size: int) -> float:
    """Return how wide a text is (px)."""
    return float(font(size).getlength(text))


class Panel:
    """A dark pane to write and draw on, ``width`` by ``height`` px; places are px from its corner on top and left."""

    def __init__(self, width: int, height: int) -> None:
        from PIL import Image, ImageDraw

        self._image = Image.new("RGBA", (width, height), (*DARK, PANEL_ALPHA))
        self.draw = ImageDraw.Draw(self._image)
        self._curves: list[tuple[Floats, Sequence[float]]] = []

    @classmethod
    def of_lines(cls, lines: Sequence[str], size: int, colors: Sequence[Sequence[float] | None] = ()) -> Panel:
        """Return a panel of lines of text, ``size`` px high, with a square before those that have a colour."""
        pad, step, tints = size // 2, round(LEADING * size), [*colors, *[None] * (len(lines) - len(colors))]
        shifts = [0 if tint is None else round(LEADING * size) for tint in tints]
        widths = [shift + width_of(line, size) for shift, line in zip(shifts, lines, strict=True)]
        panel = cls(int(max(widths)) + 2 * pad + 1, step * len(lines) + pad)
        for number, (line, shift, tint) in enumerate(zip(lines, shifts, tints, strict=True)):
            top = pad // 2 + number * step
            if tint is not None:
                fill = tuple(round(255.0 * part) for part in tint[:3])
                panel.draw.rectangle((pad, top + size // 5, pad + size - 1, top + size // 5 + size - 1), fill)
            panel.write((pad + shift, top), line, size)
        return panel

    def write(
        self,
        at: tuple[float, float],
        text: str,
        size: int,
        anchor: str = "la",
        color: Sequence[float] = (1.0, 1.0, 1.0),
    ) -> None:
        """Write a text, by its corner on top and left unless another of Pillow's anchors is given."""
        self.draw.text(at, text, tuple(round(255.0 * part) for part in color), font(size), anchor)

    def curve(self, points: Floats, color: Sequence[float]) -> None:
        """Draw a line through points (n, 2)."""
        self._curves.append((points, color))

    def paste(self, at: tuple[int, int], picture: Picture) -> None:
        """Put a picture (h, w, 3) into the panel."""
        from PIL import Image

        self._image.paste(Image.fromarray(picture), at)

    def pixels(self) -> Picture:
        """Return the panel (h, w, 4)."""
        panel = np.array(self._image)
        for points, color in self._curves:
            half, ends = np.full((len(points) - 1, 1), CURVE / 2.0), np.insert(points, 2, 0.0, axis=1)
            strokes = np.hstack([ends[:-1], ends[1:], half, half])
            colors, cover = np.tile((*color, 1.0), (len(half), 1)), np.zeros((*panel.shape[:2], 3), np.uint8)
            picture, near = np.ascontiguousarray(panel[..., :3]), np.ones(panel.shape[:2], np.float32)
            draw_strokes(strokes, colors, np.ones(len(half)), near, picture)
            draw_strokes(strokes, np.ones((len(half), 4)), np.ones(len(half)), near, cover)
            panel = np.dstack([picture, np.maximum(panel[..., 3], cover[..., 0])])
        return panel
