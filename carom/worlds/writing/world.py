"""Worlds in words: a whole one, compared with what its file loads to."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from carom.ecs import World, first_difference
from carom.ecs.errors import CaromError
from carom.systems.shapes.geometry import Geometries
from carom.systems.simulation import Simulation
from carom.worlds.builder import LoadedWorld, load_text
from carom.worlds.emit import emit
from carom.worlds.errors import WorldError
from carom.worlds.header import VERSION
from carom.worlds.state import state_words
from carom.worlds.writing.entities import EntityWriter
from carom.worlds.writing.events import event_words
from carom.worlds.writing.models import Models
from carom.worlds.writing.names import Callings
from carom.worlds.writing.refusals import refusals
from carom.worlds.writing.sections import force_words, layer_words, material_words, settings_words

TOLD = ("name", "description", "up", "variables", "run")  # of a loaded world, before what it holds
SEEN = ("cameras", "render", "recording")  # and after
FORETOLD = ("oracle", "expect")  # of a whole run, from its first step
WRITTEN = "the written world"


def write_world(world: Simulation | LoadedWorld, path: str | Path) -> None:
    """Write a world as it is now into a file that loads to the same state, to the bit; see `world_text`.

    Model files that a loaded world names are laid beside it.
    """
    models = Models(world if isinstance(world, LoadedWorld) else None)
    text = _text(world, models)
    models.lay_beside(Path(path))
    Path(path).write_text(text, encoding="utf-8")


def world_text(world: Simulation | LoadedWorld) -> str:
    """Return a world as it is now as the text of a file that loads to the same state, to the bit.

    Each entity stands for itself, in SI units, with the words that differ from the defaults. What words cannot say, as
    of a world in mid-run, stands in ``state`` at the end. Of a loaded world cameras, run and pictures are kept, and
    what it expects as long as no step is taken; it names the same model files. Raises CaromError for what no file can
    hold: systems and force functions of Python code, components of scripts.
    """
    return _text(world, Models(world if isinstance(world, LoadedWorld) else None))


def _text(world: Simulation | LoadedWorld, models: Models) -> str:
    simulation = world.simulation if isinstance(world, LoadedWorld) else world
    if faults := refusals(simulation):
        raise CaromError("\n  ".join(["the world cannot be written to a file:", *faults]))
    text = emit(_document(world, simulation, models))
    loaded = _loaded(text, models)
    if first_difference(simulation.world, loaded.world) is None and _alike(simulation.world, loaded.world):
        _confirm(simulation, loaded)
        return text
    text += "\n" + emit({"state": state_words(simulation.world, loaded.world)})
    _confirm(simulation, _loaded(text, models))
    return text


def _document(world: Simulation | LoadedWorld, simulation: Simulation, models: Models) -> dict[str, Any]:
    """Return the sections of a file but its state."""
    stated = world.document if isinstance(world, LoadedWorld) else {}
    after = [*SEEN, *FORETOLD] if simulation.frame == 0 else [*SEEN]
    kept = {key: stated[key] for key in (*TOLD, *after) if key in stated}
    if "oracle" not in kept:
        kept.pop("variables", None)
    callings = Callings(simulation.world)
    forces = force_words(simulation.world, callings)
    sections = {
        "materials": material_words(simulation.world),
        "layers": layer_words(simulation.world),
        "entities": EntityWriter(simulation.world, callings, models).all(),
        "forces": forces,
        "events": event_words(simulation.world, models),
    }
    return {
        "carom": VERSION,
        **{key: kept[key] for key in TOLD if key in kept},
        **settings_words(simulation.world, up=kept.get("up", "y")),
        **{key: words for key, words in sections.items() if words},
        **{key: kept[key] for key in after if key in kept},
    }


def _loaded(text: str, models: Models) -> Simulation:
    try:
        return load_text(text, WRITTEN, files=models.files).simulation
    except WorldError as fault:
        raise CaromError(f"the world cannot be written to a file: it would be refused:\n{fault}") from None


def _confirm(simulation: Simulation, loaded: Simulation) -> None:
    """Raise CaromError where a file has not given the world back."""
    difference = first_difference(simulation.world, loaded.world)
    if difference is not None:
        raise CaromError(f"the world cannot be written to a file: read again, {difference.what}")
    if simulation.settings != loaded.settings:
        raise CaromError("the world cannot be written to a file: its settings would be others")
    if not _alike(simulation.world, loaded.world):
        raise CaromError("the world cannot be written to a file: its meshes and hulls would be others")


def _alike(world: World, loaded: World) -> bool:
    """Tell whether geometries of the same number are the same triangles."""
    here, there = world[Geometries].items, loaded[Geometries].items
    return len(there) == len(here) and all(
        np.array_equal(one.vertices, other.vertices) and np.array_equal(one.faces, other.faces)
        for one, other in zip(here, there, strict=True)
    )
