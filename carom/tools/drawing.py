"""Drawing: marks into a finished picture."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats, Integers
from carom.tools.lettering import put_insets, write_labels
from carom.tools.marks import Arrows, Inset, Labels, Lines, Mark, Points
from carom.tools.strokes import draw_strokes
from carom.tools.view import View

HALO = 1.25  # px of dark around arrows and dots, which sets them off from bodies of any colour
HALO_ALPHA = 0.5
HEAD = 3.6  # length of an arrow's head over its width
BLUNT = 1.5  # half width of a head over the arrow's width
SHORTEST = 1.0  # px: of a shorter arrow nothing is drawn

Picture = npt.NDArray[np.uint8]
Survey = Callable[[], tuple[Integers, npt.NDArray[np.float32]]]


def draw(picture: Picture, view: View, marks: Sequence[Mark], survey: Survey) -> None:
    """Draw marks over a picture (h, w, 3), in their order, texts and insets last.

    ``survey`` returns the ids (h, w) of what is seen and its depth (h, w), 0 near and 1 far; it is asked once, when a
    mark depends on it.
    """
    needed = any(getattr(mark, "behind", 1.0) < 1.0 or getattr(mark, "rows", None) is not None for mark in marks)
    ids, depth = survey() if needed else (None, np.ones(picture.shape[:2], np.float32))
    large = view.magnification
    for mark in marks:
        if isinstance(mark, Lines):
            starts, ends = view.segments(mark.starts, mark.ends)
            _stroke(picture, depth, _strokes(starts, ends, large * mark.width / 2.0), mark)
        elif isinstance(mark, Arrows):
            shafts, heads = _arrows(view, mark, large * mark.width)
            for strokes in (shafts, heads):
                _stroke(picture, depth, strokes, mark, large * HALO)
            for strokes in (shafts, heads):
                _stroke(picture, depth, strokes, mark)
        elif isinstance(mark, Points):
            at = view.pixels(mark.positions)
            dots = _strokes(at, at, large * mark.size / 2.0)
            _stroke(picture, depth, dots, mark, large * HALO)
            _stroke(picture, depth, dots, mark)
    write_labels(picture, view, [mark for mark in marks if isinstance(mark, Labels)], ids)
    put_insets(picture, [mark for mark in marks if isinstance(mark, Inset)])


def _strokes(starts: Floats, ends: Floats, half: float | Floats) -> Floats:
    halves = np.broadcast_to(half, len(starts))
    return np.column_stack([starts, ends, halves, halves])


def _stroke(
    picture: Picture, depth: npt.NDArray[np.float32], strokes: Floats, mark: Lines | Arrows | Points, halo: float = 0.0
) -> None:
    colors = np.ascontiguousarray(mark.colors, np.float64)
    if halo:
        strokes = strokes + np.repeat((0.0, halo), (6, 2))
        colors = colors * [0.0, 0.0, 0.0, HALO_ALPHA]
    draw_strokes(np.ascontiguousarray(strokes), colors, np.full(len(strokes), mark.behind), depth, picture)


def _arrows(view: View, mark: Arrows, width: float) -> tuple[Floats, Floats]:
    """Return the strokes of shafts and of heads; the head of a short arrow is as long as the arrow."""
    starts, ends = view.segments(mark.starts, mark.ends)
    along = ends - starts
    length = np.hypot(along[:, 0], along[:, 1])
    visible = length >= SHORTEST
    share = np.minimum(1.0, HEAD * width / np.where(visible, length, 1.0))[:, None]
    starts = np.where(visible[:, None], starts, np.nan)
    necks = ends - share * along
    thick = share[:, 0] * np.where(visible, length, 0.0) / HEAD
    heads = _strokes(np.where(visible[:, None], necks, np.nan), ends, 0.0)
    heads[:, 6] = BLUNT * thick
    return _strokes(starts, necks, width / 2.0), heads
