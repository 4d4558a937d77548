"""Words of entities as Python states them, in SI: refused for what files are refused for, all of it at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from carom.ecs import Collider, Material, Motion, RigidBody, Transform, Visual
from carom.ecs.column import Column
from carom.ecs.component import Component
from carom.ecs.components.rigid_body import BodyType
from carom.systems.mass import PASSED_ON
from carom.systems.materials import COMBINE_QUANTITIES, COMBINE_RULES, MATERIAL_COLUMNS
from carom.systems.parameters import WordFault, number_fault, refusal, unknown_keys
from carom.systems.shapes import SHAPES
from carom.systems.shapes.stating import shape_faults
from carom.systems.surfaces import COLLIDER_COLUMNS

Path = tuple[str, ...]
BODY_TYPES = [kind.name.lower() for kind in BodyType]
NEARLY_ONE = 1e-6  # how far from 1 the length of a rotation may be
COLUMNS: dict[str, tuple[type[Component], Iterable[str]]] = {  # of each section, the words that are columns
    "transform": (Transform, ("position", "rotation")),
    "motion": (Motion, ("linear", "angular")),
    "body": (RigidBody, ("mass", "inertia", "principal_axes", "center_of_mass", *PASSED_ON)),
    "material": (Material, MATERIAL_COLUMNS),
    "collider": (Collider, COLLIDER_COLUMNS),
    "visual": (Visual, ("position", "rotation", "color", "visible")),
}
FURTHER: dict[str, tuple[str, ...]] = {  # and those that are not
    "body": ("type", "locked"),
    "collider": ("shape", "layer", "collides_with", "on_enter"),
    "visual": ("shape",),
}

OTHERWISE: dict[str, type] = {"material": str, "visual": bool}  # what a section may be beside a mapping


def refuse_words(words: Mapping[str, Any]) -> None:
    """Raise DeclarationError for all that is wrong with an entity; numbers may have a row for each of many."""
    if found := list(faults(words)):
        raise refusal(found)


def faults(words: Mapping[str, Any]) -> Iterator[WordFault]:
    """Yield what is wrong with each section that is stated."""
    for section, (kind, names) in COLUMNS.items():
        stated = words.get(section)
        if stated is None or isinstance(stated, OTHERWISE.get(section, ())):
            continue
        shapes = tuple(SHAPES) if section in ("collider", "visual") else ()
        known = (*shapes, *names, *FURTHER.get(section, ()))
        if not isinstance(stated, Mapping):
            yield WordFault((section,), "must be a mapping", repr(stated), ", ".join(known))
            continue
        yield from unknown_keys((section,), stated, known)
        for name in names:
            if name in stated:
                yield from _column((section, name), kind.columns[name], stated[name])
        for key in shapes:
            if isinstance(stated.get(key), Mapping):
                yield from shape_faults((section, key), SHAPES[key], stated[key])
        if section == "body" and stated.get("type", BODY_TYPES[0]) not in BODY_TYPES:
            yield WordFault(("body", "type"), "unknown word", repr(stated["type"]), ", ".join(BODY_TYPES))


def _column(path: Path, column: Column, value: Any) -> Iterator[WordFault]:
    if column.dtype == np.bool_:
        if np.asarray(value).dtype != np.bool_:
            yield WordFault(path, "must be true or false", repr(value))
        return
    if path[0] == "material" and path[1] in COMBINE_QUANTITIES and isinstance(value, Mapping):
        yield from unknown_keys(path, value, ("value", "combine"))
        if value.get("combine") not in COMBINE_RULES:
            received = repr(value["combine"]) if "combine" in value else "none"
            yield WordFault((*path, "combine"), "unknown word", received, ", ".join(COMBINE_RULES))
        path, value = (*path, "value"), value.get("value")
    width = column.shape[-1] if column.shape else None
    if path[-1] == "color" and np.shape(value)[-1:] == (3,):
        width = 3  # without alpha
    if wrong := number_fault({"unit": column.unit, "width": width, "rows": True, **column.bounds}, value):
        yield WordFault(path, wrong)
    elif path[-1] in ("rotation", "principal_axes"):
        lengths = np.sqrt((np.asarray(value, np.float64) ** 2).sum(axis=-1))
        if (off := np.abs(lengths - 1.0) > NEARLY_ONE).any():
            yield WordFault(path, f"must be a unit quaternion xyzw, received one of length {lengths[off].flat[0]:.9g}")
