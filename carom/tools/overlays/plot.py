"""Plot: a quantity over time, in a corner."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from carom.ecs import World
from carom.ecs.column import Floats
from carom.systems.settings import time_of
from carom.tools.coloring import FEW
from carom.tools.marks import Inset, Mark
from carom.tools.overlays.overlay import Overlay, Seen
from carom.tools.panel import Panel, text_size, width_of
from carom.tools.quantities import Quantity
from carom.tools.round_numbers import next_round

SHARE, LEAST = np.array((0.36, 0.28)), np.array((160, 110))  # of the picture, and px at least
COLORS = np.minimum(FEW[[1, 4, 2, 3, 5, 6]] * 1.25, 1.0)  # bright, on a dark pane
GRID = (100, 106, 116)
GAP = 4  # px


class Plot(Overlay):
    """The curves of a quantity from the start until now, with zero in sight; scales end at round numbers."""

    def __init__(self, quantity: Quantity) -> None:
        self._quantity = quantity
        self._times: list[float] = []
        self._values: list[list[float]] = []
        self._names: list[str] = []

    def watch(self, world: World) -> None:
        """Keep the values of now."""
        values = self._quantity.read(world)
        self._names = list(values)
        self._times.append(time_of(world))
        self._values.append(list(values.values()))

    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return the plot of what was watched, or of now alone."""
        if not self._times:
            self.watch(seen.world)
        size = text_size(seen.view.height)
        width, height = np.maximum(SHARE * (seen.view.width, seen.view.height), LEAST).astype(int).tolist()
        panel, values = Panel(width, height), np.array(self._values)
        low, high = ends(values)
        top = self._write_names(panel, size)
        left = size // 2 + GAP + max(round(width_of(f"{value:g}", size)) for value in (low, high))
        right, bottom = width - size // 2, height - round(1.7 * size)
        upward = (bottom - top) / (high - low)
        panel.draw.rectangle((left, top, right, bottom), outline=GRID)
        panel.draw.line((left, top + high * upward, right, top + high * upward), fill=GRID)
        for value, at in ((high, top), (low, bottom)):
            panel.write((left - GAP, at), f"{value:g}", size, "rm")
        for time, at, anchor in ((self._times[0], left, "la"), (self._times[-1], right, "ra")):
            panel.write((at, bottom + GAP), f"{time:.3g} s", size, anchor)
        times = np.array(self._times)
        across = (times - times[0]) / max(times[-1] - times[0], 1e-9)
        for number, curve in enumerate(values.T):
            points = np.column_stack([left + across * (right - left), top + (high - curve) * upward])
            points = points[~np.isnan(curve)]  # who is not there has no value
            if len(points):
                panel.curve(thinned(points), COLORS[number % len(COLORS)])
        return [Inset(panel.pixels(), "top left")]

    def _write_names(self, panel: Panel, size: int) -> int:
        """Write the title and the names of several curves; return where there is room below (px)."""
        unit = "" if self._quantity.unit == "1" else f", {self._quantity.unit}"
        panel.write((size // 2, size // 3), f"{self._quantity.title}{unit}", size)
        if len(self._names) < 2:
            return 2 * size
        at = size // 2
        letters = enumerate(zip(*self._names, strict=False))
        shared = next((number for number, letter in letters if len(set(letter)) > 1), 0)
        for number, name in enumerate(self._names):
            panel.write((at, round(1.6 * size)), name[shared:], size, color=COLORS[number % len(COLORS)])
            at += round(width_of(name[shared:], size)) + size // 2
        return round(3.3 * size)


def ends(values: Floats) -> tuple[float, float]:
    """Return round numbers around values and zero; around zeros alone, or no numbers, 0 and 1."""
    low, high = float(np.nanmin(values, initial=0.0)), float(np.nanmax(values, initial=0.0))
    lowest, highest = -next_round(-low) if low < 0.0 else 0.0, next_round(high) if high > 0.0 else 0.0
    return (lowest, highest) if lowest < highest else (0.0, 1.0)


def thinned(points: Floats) -> Floats:
    """Return points (m, 2) in order of x with no more than the first, lowest, highest and last of each pixel's."""
    columns = np.floor(points[:, 0])
    first = np.nonzero(np.diff(columns, prepend=-np.inf))[0]
    ordered = np.lexsort((points[:, 1], columns))
    last = np.append(first[1:], len(points)) - 1
    chosen = np.unique(np.concatenate([first, last, ordered[first], ordered[last]]))
    return np.asarray(points[chosen])
