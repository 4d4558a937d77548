"""Legend: what the colours of a recording's views mean, as a text."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from carom.tools.coloring import FEW, GRAY, SLEEP, Coloring, Legend

#: Words for the colours that name something; more layers than there are of them share some.
WORDS = dict(
    zip(
        ("blue", "orange", "green", "pink", "sky blue", "vermilion", "yellow", "dark gray"),
        map(tuple, FEW),
        strict=True,
    )
) | {"gray": GRAY, "pale yellow": SLEEP["eligible"], "slate blue": SLEEP["asleep"]}
OTHERWISE = {
    "material": "each its own, as it looks",
    "island": "one for those that touch, directly or by way of others; gray for what cannot be pushed",
}


def legend_text(colorings: Mapping[str, Coloring], titles: Mapping[str, str]) -> str:
    """Return a line for each mode, called by its title."""
    lines = []
    for mode, coloring in colorings.items():
        told = OTHERWISE.get(mode) if coloring.legend is None else _told(coloring.legend)
        lines.append(f"- **{titles[mode]}**: {told}")
    return "\n".join(lines)


def _told(legend: Legend) -> str:
    if not legend.names:
        return f"{legend.title} from 0, dark blue, by green to {legend.most:g} {legend.unit}, yellow"
    return ", ".join(f"{name} {_word(color)}" for name, color in zip(legend.names, legend.colors, strict=True))


def _word(color: tuple[float, ...]) -> str:
    away = np.linalg.norm(np.array(list(WORDS.values())) - np.array(color), axis=1)
    return list(WORDS)[int(away.argmin())]
