"""Legends: what the colours of a picture mean, as an inset."""

from __future__ import annotations

import numpy as np

from carom.tools.coloring import Legend, on_scale
from carom.tools.marks import Inset
from carom.tools.panel import Panel, text_size
from carom.tools.view import View

BAR = 9  # width of the bar of a scale over the height of a text


def legend_inset(legend: Legend, view: View) -> Inset:
    """Return names beside their colours, or a bar from 0 to the end of the scale."""
    size = text_size(view.height)
    if legend.names:
        panel = Panel.of_lines([legend.title, *legend.names], size, [None, *legend.colors])
        return Inset(panel.pixels(), "bottom right")
    panel = Panel(BAR * size, round(4.2 * size))
    bar = np.tile(on_scale(np.linspace(0.0, 1.0, (BAR - 1) * size)), (size, 1, 1))
    panel.write((size // 2, size // 3), f"{legend.title}, {legend.unit}", size)
    panel.paste((size // 2, round(1.75 * size)), np.rint(255.0 * bar).astype(np.uint8))
    panel.write((size // 2, round(2.9 * size)), "0", size)
    panel.write((BAR * size - size // 2, round(2.9 * size)), f"{legend.most:g}", size, "ra")
    return Inset(panel.pixels(), "bottom right")
