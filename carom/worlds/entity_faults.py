"""Entity faults: what is wrong with the words of an entity beside the world it is for, told before it is made."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from carom.ecs import World
from carom.systems.layers import Layers
from carom.systems.materials import Materials
from carom.systems.parameters import WordFault
from carom.systems.particles.words import read_emitter
from carom.systems.paths import faults_of_path
from carom.worlds.errors import WordError
from carom.worlds.names import known


def faults_of(world: World, words: dict[str, Any], copying: Sequence[str]) -> Iterator[WordFault]:
    """Yield all faults of words, putting an emitter in the place of its own; ``copying`` is the generator stated."""
    yield from _unknown_names(world, words)
    if "keyframes" in words:
        yield from faults_of_path(words)
        for key in copying:
            yield WordFault((key,), f"all copies would go the same way; remove {key} or keyframes")
    if "emitter" in words:
        wrong: list[WordFault] = []
        words["emitter"] = read_emitter(words["emitter"], wrong)
        yield from wrong


def _unknown_names(world: World, words: dict[str, Any]) -> Iterator[WordFault]:
    """Yield names of materials and layers that nothing defines."""
    layers, materials = world[Layers].bits, world[Materials].named
    collider = words.get("collider", {})
    uses: list[tuple[tuple[str | int, ...], str, str, Any]] = []
    if isinstance(words.get("material"), str):
        uses.append((("material",), "material", words["material"], materials))
    if "layer" in collider:
        uses.append((("collider", "layer"), "layer", collider["layer"], layers))
    for number, name in enumerate(collider.get("collides_with", ())):
        uses.append((("collider", "collides_with", number), "layer", name, layers))
    if "on_enter" in collider:
        uses.append((("collider", "on_enter", "layer"), "layer", collider["on_enter"]["layer"], layers))
    for place, kind, name, choices in uses:
        try:
            known(kind, name, choices)
        except WordError as fault:
            yield WordFault(place, fault.what, fault.received, fault.accepted, fault.hint, fault.name)
