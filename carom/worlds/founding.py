"""Founding: the world of a file before anybody is in it, with its settings, materials and layers."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from carom.ecs.errors import DeclarationError
from carom.systems.settings import Random, Settings
from carom.systems.simulation import Simulation
from carom.worlds.generated.settings import STEP_WORDS
from carom.worlds.source import Source

STANDARD_GRAVITY = {"y": (0.0, -9.81, 0.0), "z": (0.0, 0.0, -9.81)}


def founded(source: Source, values: dict[str, Any], checked: bool | None, options: dict[str, Any]) -> Simulation:
    """Return an empty world of the checked sections of a file; ``options`` override settings. Report what is wrong."""
    settings = {f.name: values[f.name] for f in fields(Settings) if f.name not in STEP_WORDS}
    if "gravity" not in source.data:
        settings["gravity"] = STANDARD_GRAVITY[values["up"]]
    if values["step"] is not None:
        settings |= values["step"].model_dump(exclude_unset=True)
    settings |= {key: value for key, value in options.items() if value is not None}
    if settings["dimensions"] == 2 and settings["gravity"][2]:
        place, received = ("gravity" if "gravity" in source.data else "up"), str(list(settings["gravity"]))
        what = "gravity must lie in the plane of dimensions: 2"
        source.report((place,), what, received=received, accepted="[x, y, 0]")
        settings["gravity"] = (*settings["gravity"][:2], 0.0)
    simulation = Simulation(checked=checked, **settings)
    simulation.world[Random].draw(values["drawn"] or 0)
    for name, words in values["materials"].items():
        simulation.material(name, **({} if words is None else words.model_dump(exclude_unset=True)))
    try:
        simulation.layers(values["layers"])
    except DeclarationError as fault:
        source.report(("layers",), str(fault))
    return simulation
