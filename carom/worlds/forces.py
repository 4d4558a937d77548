"""The ``forces`` section of a world file to force laws."""

from __future__ import annotations

from typing import Any

from carom.ecs.errors import DeclarationError
from carom.systems.forces import LAWS, Forces
from carom.systems.forces.reach import read_reach
from carom.systems.layers import Layers
from carom.systems.parameters import WordFault
from carom.systems.simulation import Simulation
from carom.worlds.errors import WordError
from carom.worlds.names import matching, whole_of_copy
from carom.worlds.source import Source


def add_forces(source: Source, simulation: Simulation, forces: list[Any]) -> None:
    """Add the force laws of checked words (None: already reported); report what is wrong with them."""
    names = simulation.world.names()
    for index, words in enumerate(forces):
        if words is None:
            continue
        stated = words.model_dump(exclude_unset=True)
        patterns, *limits = (stated.pop(word, None) for word in ("entities", "region", "layers", "during"))
        if len(stated) != 1:
            received, accepted = ", ".join(stated) or "none", ", ".join(sorted(LAWS))
            source.report(("forces", index), "must state one force", received=received, accepted=accepted)
            continue
        found: list[str] = []
        for number, pattern in enumerate(patterns or ()):
            try:
                found += matching(pattern, names)
            except WordError as fault:
                if whole_of_copy(pattern) in _brought(source):
                    fault.hint = "it comes by an event; state its layer in layers instead"
                source.report_value(("forces", index, "entities", number), fault)
        ((key, parameters),) = stated.items()
        entities = None if patterns is None else [simulation.world.find(name) for name in found]
        wrong: list[WordFault] = []
        reach = read_reach(simulation.world[Layers], wrong, entities, *limits)
        for word in wrong:
            source.report_value(("forces", index, *word.steps), word)
        try:
            simulation.world[Forces].add(LAWS[key](**parameters), reach)
        except DeclarationError as fault:
            source.report(("forces", index, key), str(fault))


def _brought(source: Source) -> set[str]:
    """Return the names of whom events bring."""
    events = source.data.get("events")
    spawned = [event.get("spawn") for event in (events if isinstance(events, list) else ()) if isinstance(event, dict)]
    return {str(words["name"]) for words in spawned if isinstance(words, dict) and "name" in words}
