"""What registries hold in files: models of shapes, force laws, joints, actions and generators by what they declare."""

from __future__ import annotations

import dataclasses
from typing import Any, get_type_hints

from pydantic import Field, create_model

from carom.systems.actions import ACTIONS, Spawn
from carom.systems.forces import LAWS
from carom.systems.joints import JOINTS
from carom.systems.shapes import SHAPES
from carom.worlds.color import ColorWord
from carom.worlds.generated.fields import Fields, description, first_line, hinted, numbers
from carom.worlds.generators import GENERATORS
from carom.worlds.geometry import GEOMETRY_WORDS
from carom.worlds.values import In, Words, either, word_of


def parameter_model(kind: type[Any]) -> type[Words]:
    """Return the model of a dataclass whose fields are declared: a shape, a force law or a joint, or a part of one."""
    if kind.__dict__.get("key") in GEOMETRY_WORDS:
        return GEOMETRY_WORDS[kind.key]
    hints = get_type_hints(kind)
    fields: Fields = {}
    for field in dataclasses.fields(kind):
        unit, doc = field.metadata.get("unit", "1"), field.metadata.get("doc", field.name)
        kept = ... if field.default is dataclasses.MISSING else field.default
        fields[field.name] = (_field_type(hints[field.name], field), Field(kept, description=description(doc, unit)))
    return create_model(kind.__name__, __base__=Words, __doc__=kind.__doc__, **fields)


def _field_type(hint: Any, field: dataclasses.Field[Any]) -> Any:
    declared = field.metadata
    if "entity" in declared:
        return str
    if "names" in declared:
        return list[str]
    if "part" in declared:
        model = parameter_model(declared["part"])
        return either(word_of(*declared["words"]), model) if declared["words"] else model
    if "choices" in declared:
        return word_of(*declared["choices"])
    if "color" in declared:
        return ColorWord
    bounds: dict[str, Any] = {key: declared.get(key) for key in ("above", "least", "most")}
    if declared.get("span"):
        number, pair = (numbers(width, In(declared["unit"], **bounds)) for width in (1, 2))
        return either(number, pair, list)
    return hinted(hint, declared.get("unit", "1"), width=declared.get("width", 1), **bounds)


def shape_fields() -> Fields:
    """Return one optional field per shape."""
    kinds = sorted(SHAPES.items())
    return {key: (parameter_model(kind), Field(None, description=first_line(kind))) for key, kind in kinds}


def generator_fields() -> Fields:
    """Return one optional field per generator."""
    return {key: (kind, Field(None, description=first_line(kind))) for key, kind in GENERATORS.items()}


def joint_fields() -> Fields:
    """Return one optional field per kind of joint."""
    kinds = sorted(JOINTS.items())
    return {key: (parameter_model(kind), Field(None, description=first_line(kind))) for key, kind in kinds}


def action_fields() -> Fields:
    """Return one optional field per action of events but `Spawn`; one that takes names only is a list of them."""
    fields: Fields = {}
    for key, kind in ACTIONS.items():
        if kind is not Spawn:
            names_only = [field.name for field in dataclasses.fields(kind)] == ["entities"]  # type: ignore[arg-type]
            model: Any = list[str] if names_only else parameter_model(kind)
            fields[key] = (model, Field(None, description=first_line(kind)))
    return fields


def law_fields() -> Fields:
    """Return one optional field per force law."""
    return {key: (parameter_model(kind), Field(None, description=first_line(kind))) for key, kind in LAWS.items()}
