"""Look: how a world is drawn beyond its bodies' own colours, by the words of files and commands."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import partial

from carom.tools.coloring import MODES
from carom.tools.overlays import OVERLAYS
from carom.tools.quantities import quantity
from carom.worlds.builder import LoadedWorld
from carom.worlds.errors import Fault, WordError
from carom.worlds.names import known


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

    Raises WorldError for every unknown overlay, mode of colour and quantity at once, those of the file at their places.
    """
    render = loaded.render
    wanted = tuple(dict.fromkeys(render.overlays if overlays is None else overlays))
    measured = tuple(dict.fromkeys(render.plots if plots is None else plots))
    mode = render.color if color is None else color
    faults: list[tuple[str, str, WordError]] = []
    for key, words, check in (
        ("overlays", wanted, partial(known, "overlay", choices=sorted(OVERLAYS))),
        ("color", (mode,), partial(known, "mode of colour", choices=sorted(MODES))),
        ("plots", measured, partial(quantity, world=loaded.simulation.world)),
    ):
        for word in words:
            try:
                check(word)
            except WordError as fault:
                faults.append((key, word, fault))
    if faults:
        stated = {"overlays": overlays, "color": color, "plots": plots}
        _refuse(loaded, [key for key in stated if stated[key] is not None], faults)
    return Look(wanted, mode, render.wireframe if wireframe is None else wireframe, measured)


def _refuse(loaded: LoadedWorld, stated: list[str], faults: list[tuple[str, str, WordError]]) -> None:
    """Raise WorldError for words by their keys; they stand in the file but for keys that were stated otherwise."""
    source = replace(loaded.source, faults=[])
    for key, word, fault in faults:
        if key in stated:
            told = fault.what, fault.received, fault.accepted, fault.hint
            source.faults.append(Fault(loaded.path, 0, 0, key, *told))
        else:
            words = getattr(loaded.render, key)
            number = () if isinstance(words, str) else (words.index(word),)
            source.report_value(("render", key, *number), fault)
    source.refuse_if_faulty()
