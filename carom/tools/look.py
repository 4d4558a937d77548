"""Look: how a world is drawn beyond its bodies' own colours, by the words of files and commands."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from carom.ecs.errors import CaromError, did_you_mean
from carom.tools.coloring import MODES
from carom.tools.overlays import OVERLAYS
from carom.tools.quantities import quantity
from carom.worlds.builder import LoadedWorld
from carom.worlds.errors import WordError


@dataclass(frozen=True)
class Look:
    """Overlays, mode of colour and plotted quantities by their words, and whether bodies are drawn as edges only."""

    overlays: tuple[str, ...] = ()
    color: str = "material"
    wireframe: bool = False
    plots: tuple[str, ...] = ()


def look_of(
    loaded: LoadedWorld,
    overlays: Iterable[str] | None = None,
    color: str | None = None,
    wireframe: bool | None = None,
    plots: Iterable[str] | None = None,
) -> Look:
    """Return the look a world file states, except for what is stated here.

    Raises CaromError for every unknown overlay, mode of colour and quantity at once.
    """
    render = loaded.render
    wanted = tuple(dict.fromkeys(render.overlays if overlays is None else overlays))
    color = render.color if color is None else color
    faults = [_unknown("overlay", name, OVERLAYS) for name in wanted if name not in OVERLAYS]
    faults += [_unknown("mode of colour", name, MODES) for name in (color,) if name not in MODES]
    measured = tuple(dict.fromkeys(render.plots if plots is None else plots))
    for text in measured:
        try:
            quantity(text, loaded.simulation.world)
        except WordError as fault:
            faults.append(fault.line("plot"))
    if faults:
        raise CaromError("\n".join(f"{loaded.path}: {fault}" for fault in faults))
    return Look(wanted, color, render.wireframe if wireframe is None else wireframe, measured)


def _unknown(kind: str, name: str, choices: Iterable[str]) -> str:
    names = sorted(choices)
    parts = f"no {kind} is named {name!r}", f"accepted: {', '.join(names)}", did_you_mean(name, names)
    return "; ".join(filter(None, parts))
