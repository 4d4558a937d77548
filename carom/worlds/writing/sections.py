"""Sections in words: settings, materials, layers and forces of a world."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Any

import numpy as np

from carom.ecs import World
from carom.ecs.errors import CaromError
from carom.systems.forces import LAWS, Forces
from carom.systems.forces.reach import END, Reach
from carom.systems.layers import EVERYTHING, Layers
from carom.systems.materials import Materials
from carom.systems.parameters import same, words_of
from carom.systems.settings import Random, Settings
from carom.worlds.generated.settings import STEP_WORDS
from carom.worlds.writing.columns import Words, color_words, plain
from carom.worlds.writing.names import Callings

PREDEFINED = Layers()


def settings_words(world: World, *, up: str = "y") -> Words:
    """Return the settings that are not the defaults, and how far the generator has gone."""
    settings, top, step = world[Settings], dict[str, Any](), dict[str, Any]()
    for field in fields(Settings):
        value = getattr(settings, field.name)
        if not same(value, field.default) or (field.name == "gravity" and up != "y"):
            (step if field.name in STEP_WORDS else top)[field.name] = plain(value)
    if step.get("dt", 1.0) < 1.0 and same(1.0 / round(1.0 / step["dt"]), step["dt"]):
        step["dt"] = f"1/{round(1.0 / step['dt'])}"
    drawn = world[Random].drawn(settings.seed)
    return top | ({"drawn": drawn} if drawn else {}) | ({"step": step} if step else {})


def material_words(world: World) -> Words:
    """Return the named materials."""
    said = {name: plain(dict(words)) for name, words in world[Materials].named.items()}
    return {name: words | _colored(words) for name, words in said.items()}


def _colored(words: Words) -> Words:
    return {"color": color_words(words["color"])} if "color" in words else {}


def layer_words(world: World) -> Words:
    """Return the layers, each with those it meets."""
    layers = world[Layers]
    return {
        name: "all" if mask == EVERYTHING else layer_names(layers, mask)
        for name, mask in layers.masks.items()
        if PREDEFINED.masks.get(name) != mask
    }


def layer_names(layers: Layers, mask: int) -> list[str]:
    """Return the layers whose bits a mask holds."""
    return [name for name, bit in layers.bits.items() if bit and bit & mask]


def force_words(world: World, callings: Callings) -> list[Words]:
    """Return the force laws, those of a kind in their order; raise CaromError for one that no file can state."""
    said = []
    for kind, entries in world[Forces].entries.items():
        if LAWS.get(kind.key) is not kind:
            raise CaromError(f"force law {kind.__name__} is not among those of files, {', '.join(sorted(LAWS))}")
        said += [{kind.key: plain(words_of(law))} | reach_words(world, reach, callings) for law, reach in entries]
    return said


def reach_words(world: World, reach: Reach, callings: Callings) -> Words:
    """Return whom a law acts on, where and when."""
    words: Words = {}
    if reach.entities is not None:
        handles = np.array(reach.entities, np.int64)
        words["entities"] = [callings.of(entity) for entity in handles[world.slots.live(handles)].tolist()]
    if reach.region is not None:
        words["region"] = plain(words_of(reach.region))
    if reach.layers is not None:
        names = {bit: name for name, bit in world[Layers].bits.items()}
        words["layers"] = [names[bit] for bit in reach.layers]
    if reach.during is not None:
        start, end = reach.during
        words["during"] = [start, END if math.isinf(end) else end]
    return words
