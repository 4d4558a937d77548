"""Strokes: straight lines, heads of arrows and dots, drawn into a finished picture with soft edges."""

from __future__ import annotations

from math import ceil, floor, sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import kernel


@kernel("picture")
def draw_strokes(strokes, colors, behind, depth, picture):
    """Draw strokes over a picture (h, w, 3), one after another.

    ``strokes`` (n, 8) are x, y (px from the corner on top and left) and depth of both ends, then half the width (px)
    at both; one that tapers begins flat. ``colors`` (n, 4) are in 0..1; ``behind`` (n,) is the share of the alpha where
    ``depth`` (h, w), in the same measure, is nearer. A pixel is covered by as much as the edge is beyond its centre.
    """
    height, width = depth.shape
    for s in range(len(strokes)):
        x, y, z, to_x, to_y, to_z, wide, to_wide = strokes[s]
        along_x, along_y = to_x - x, to_y - y
        squared = along_x * along_x + along_y * along_y
        if not squared < 1e16:  # nor a number
            continue
        length, reach = sqrt(squared), max(wide, to_wide) + 0.5
        top, bottom = max(min(y, to_y) - reach, 0.0), min(max(y, to_y) + reach, float(height))
        for row in range(floor(top), ceil(bottom)):
            at_y = row + 0.5
            first, last = 0.0, 1.0  # the part of the stroke that this row may meet
            if along_y != 0.0:
                one, other = (at_y - reach - y) / along_y, (at_y + reach - y) / along_y
                first, last = max(first, min(one, other)), min(last, max(one, other))
            one, other = x + first * along_x, x + last * along_x
            left, right = max(min(one, other) - reach, 0.0), min(max(one, other) + reach, float(width))
            for column in range(floor(left), ceil(right)):
                at_x = column + 0.5
                share = ((at_x - x) * along_x + (at_y - y) * along_y) / squared if squared > 0.0 else 0.0
                part = min(max(share, 0.0), 1.0)
                off_x, off_y = at_x - x - part * along_x, at_y - y - part * along_y
                cover = wide + part * (to_wide - wide) + 0.5 - sqrt(off_x * off_x + off_y * off_y)
                if wide > to_wide:
                    cover = min(cover, share * length + 0.5)
                if cover <= 0.0:
                    continue
                alpha = min(cover, 1.0) * colors[s, 3]
                if z + part * (to_z - z) > depth[row, column]:
                    alpha *= behind[s]
                for k in range(3):
                    below = float(picture[row, column, k])
                    picture[row, column, k] = int(below + alpha * (255.0 * colors[s, k] - below) + 0.5)


def compile_strokes() -> None:
    """Draw nothing, for `carom warm`."""
    draw_strokes(
        np.zeros((0, 8)), np.zeros((0, 4)), np.zeros(0), np.ones((1, 1), np.float32), np.zeros((1, 1, 3), np.uint8)
    )
