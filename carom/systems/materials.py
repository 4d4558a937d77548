"""Materials: surfaces and substances by name, and the components that they are of an entity."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from carom.ecs import Combine, Material, World
from carom.ecs.column import Floats
from carom.ecs.component import Resource
from carom.ecs.errors import DeclarationError

Words = Mapping[str, Any]
COMBINE_QUANTITIES = ("friction", "restitution")
COMBINE_RULES = [rule.name.lower() for rule in Combine if rule is not Combine.DEFAULT]
MATERIAL_COLUMNS = [name for name in Material.columns if name != "number" and not name.endswith("_combine")]


class Materials(Resource):
    """Materials by name, each as the words of a material."""

    def __init__(self) -> None:
        self.named: dict[str, Words] = {}

    def name(self, number: int) -> str:
        """Return the name of the material of that number, as in `Material` and `Hit`; empty for -1."""
        return "" if number < 0 else list(self.named)[number]


def material_of(world: World, material: str | Words | None) -> Material:
    """Return the Material bundle of a name or of words; quantities may be ``{value, combine}``."""
    values: dict[str, Any] = {}
    if isinstance(material, str):
        named = world[Materials].named
        if material not in named:
            raise DeclarationError(f"unknown material {material!r}; the materials are {', '.join(named) or 'none'}")
        values["number"] = list(named).index(material)
        material = named[material]
    for key, value in (material or {}).items():
        if key in COMBINE_QUANTITIES and isinstance(value, Mapping):
            values[key] = value["value"]
            values[f"{key}_combine"] = Combine[value["combine"].upper()].value
        else:
            values[key] = opaque(value) if key == "color" else value
    return Material(**values)


def opaque(color: Any) -> Floats:
    """Return colours (..., 4) of such (..., 3) or (..., 4), with an alpha of 1 where none is stated."""
    given = np.asarray(color, np.float64)
    return given if given.shape[-1] == 4 else np.concatenate([given, np.ones((*given.shape[:-1], 1))], axis=-1)
