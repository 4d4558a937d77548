"""Lettering: labels and insets put into finished pictures."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from carom.ecs.column import Booleans, Integers
from carom.tools.marks import Inset, Labels
from carom.tools.panel import DARK, Picture, font, text_size, width_of
from carom.tools.view import View

OUTLINE = 2  # px of dark around letters, which sets them off from bodies of any colour
BESIDE = 6  # px from a point to its label
MARGIN = 8  # px between insets and the edge of the picture

Box = tuple[int, int, int, int]  # left, top, right, bottom


def put_insets(picture: Picture, insets: Sequence[Inset]) -> None:
    """Put insets into their corners: one after another up or down the edge, then beside; leave out what has no room."""
    taken: list[Box] = []
    there: dict[str, list[Box]] = defaultdict(list)
    for inset, corner in insets:
        box = room_for(inset.shape, corner, picture.shape, there[corner], taken)
        if box is None:
            continue
        taken.append(box)
        there[corner].append(box)
        left, top, right, bottom = box
        part, alpha = picture[top:bottom, left:right], inset[..., 3:] / 255.0
        part[:] = np.rint(part + alpha * (inset[..., :3] - part.astype(np.float64))).astype(np.uint8)


def room_for(
    size: Sequence[int], corner: str, whole: Sequence[int], there: Sequence[Box], taken: Sequence[Box]
) -> Box | None:
    """Return the place of an inset (h, w, ..) in a picture (h, w, ..), beside those ``there`` in its corner."""
    (high, wide), (height, width) = size[:2], whole[:2]
    for shift in sorted({MARGIN, *(distance + MARGIN for box in there for distance in (box[2], width - box[0]))}):
        for drop in sorted({MARGIN, *(distance + MARGIN for box in there for distance in (box[3], height - box[1]))}):
            left = shift if corner.endswith("left") else width - shift - wide
            top = drop if corner.startswith("top") else height - drop - high
            box = left, top, left + wide, top + high
            inside = left >= 0 and top >= 0 and left + wide <= width and top + high <= height
            if inside and not any(_overlap(box, other) for other in taken):
                return box
    return None


def write_labels(picture: Picture, view: View, labels: Sequence[Labels], ids: Integers | None) -> None:
    """Write labels beside their points; one that would cover an earlier one is left out."""
    from PIL import Image, ImageDraw

    size, taken = text_size(view.height), np.zeros((view.height, view.width), np.bool_)
    image = Image.fromarray(picture)
    draw = ImageDraw.Draw(image)
    for label in labels:
        shown = np.nonzero(_shown(view, label, ids))[0]
        places = view.pixels(label.positions[shown])[:, :2] + (BESIDE, 0.0)
        for number, (x, y) in zip(shown.tolist(), places.tolist(), strict=True):
            text = label.texts[number]
            right = int(x + width_of(text, size)) + OUTLINE
            box = slice(max(0, round(y) - size // 2), round(y) + size // 2), slice(round(x) - OUTLINE, right)
            if taken[box].any():
                continue
            taken[box] = True
            fill = tuple(int(255.0 * part) for part in label.colors[number, :3])
            draw.text((x, y), text, fill, font(size), "lm", stroke_width=OUTLINE, stroke_fill=DARK)
    if taken.any():
        picture[:] = np.asarray(image)


def _shown(view: View, label: Labels, ids: Integers | None) -> Booleans:
    shown = view.contains(label.positions)
    return shown if label.rows is None or ids is None else shown & np.isin(label.rows, ids)


def _overlap(one: Sequence[float], other: Sequence[float]) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
