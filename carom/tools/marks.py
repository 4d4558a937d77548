"""Marks: what is drawn over the bodies of a picture, as arrays in metres of the world."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats, Integers

Color = tuple[float, float, float]
Corner = Literal["top left", "top right", "bottom left", "bottom right"]


class Lines(NamedTuple):
    """Lines from ``starts`` (n, 3) to ``ends`` (n, 3), ``width`` px wide, one or (n,), whatever their distance.

    In pictures higher than 480 px widths and sizes of marks grow in proportion. ``colors`` (n, 4) are as on a screen;
    ``behind`` is the share of their alpha where a body is in front of them: 1 is drawn over everything, 0 is hidden.
    """

    starts: Floats
    ends: Floats
    colors: Floats
    width: float | Floats = 2.0
    behind: float = 1.0


class Arrows(NamedTuple):
    """Arrows with their points at ``ends``; otherwise as `Lines`."""

    starts: Floats
    ends: Floats
    colors: Floats
    width: float = 3.0
    behind: float = 1.0


class Points(NamedTuple):
    """Dots ``size`` px across at ``positions`` (n, 3); otherwise as `Lines`."""

    positions: Floats
    colors: Floats
    size: float = 7.0
    behind: float = 1.0


class Labels(NamedTuple):
    """Texts beside ``positions`` (n, 3); of those with ``rows`` (n,) only where a pixel of that row is seen."""

    positions: Floats
    texts: Sequence[str]
    colors: Floats
    rows: Integers | None = None


class Inset(NamedTuple):
    """A picture (h, w, 4) put into a corner, above or below those that are there already."""

    picture: npt.NDArray[np.uint8]
    corner: Corner


Mark = Lines | Arrows | Points | Labels | Inset


def tinted(color: Color, count: int, alpha: float = 1.0) -> Floats:
    """Return one colour for ``count`` marks (n, 4)."""
    return np.tile((*color, alpha), (count, 1))
