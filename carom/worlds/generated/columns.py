"""Components in files: models of their columns, which say unit, meaning, default and bounds."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any

import numpy as np
from pydantic import Field, create_model

from carom.ecs import Material
from carom.ecs.column import Column
from carom.ecs.component import Component
from carom.ecs.errors import DeclarationError
from carom.systems.extensions import origin
from carom.systems.materials import COMBINE_QUANTITIES, COMBINE_RULES, MATERIAL_COLUMNS
from carom.systems.own_components import components_of_files
from carom.worlds.color import ColorWord
from carom.worlds.errors import WordError
from carom.worlds.generated.fields import Fields, description, first_line, numbers
from carom.worlds.rotation import RotationWord
from carom.worlds.units import parse_unit
from carom.worlds.values import Flag, In, Text, Whole, Words, either, word_of

SPECIAL = {"rotation": RotationWord, "principal_axes": RotationWord, "color": ColorWord}


def column_fields(kind: type[Component], *names: str) -> Fields:
    """Return model fields for columns of a component: unit, meaning and default are the column's."""
    return {name: (_column_type(name, kind.columns[name]), _column_field(kind.columns[name])) for name in names}


def _column_type(name: str, column: Column) -> Any:
    if name in SPECIAL and column.shape == (4,):
        return SPECIAL[name]
    shape = column.shape
    if holds_entities(column):
        kind: Any = str
    elif column.dtype == np.bool_:
        kind = Flag
    elif column.dtype.kind == "U":
        kind = Annotated[str, Text(column.dtype.itemsize // 4)]
    elif column.dtype.kind in "iu":
        held = np.iinfo(column.dtype)
        kind = Annotated[int, Whole(int(held.min), int(held.max))]
    else:
        kind, shape = numbers(shape[-1] if shape else 1, In(column.unit, **column.bounds)), shape[:-1]
    for width in reversed(shape):
        kind = tuple.__class_getitem__((kind,) * width)
    return kind


def holds_entities(column: Column) -> bool:
    """Tell whether a file states names of entities for a column."""
    return column.holds == "entities"


def _column_field(column: Column) -> Any:
    if holds_entities(column):
        return Field(None, description=f"{column.doc}: the name of an entity")
    default = np.broadcast_to(np.asarray(column.default, column.dtype), column.shape).tolist()
    if isinstance(default, list):
        default = tuple(default)  # of which pydantic makes no copy for each entity
    return Field(default, description=description(column.doc, column.unit))


def own_fields(taken: Iterable[str]) -> Fields:
    """Return one optional field per component of extensions, none of them called like a word that is ``taken``."""
    fields: Fields = {}
    for key, kind in components_of_files().items():
        where = f"component {kind.__name__} of {origin(kind.__module__)}"
        if key in taken:
            raise DeclarationError(f"{where} has the key {key!r}, which is a word of every entity; rename it")
        state = [name for name, column in kind.columns.items() if column.role == "state"]
        for name in state:
            try:
                parse_unit(kind.columns[name].unit)
            except WordError as fault:
                mend = "use SI units, '1' for counts"
                raise DeclarationError(f"{where}: column '{name}': {fault.what}; {mend}") from None
        model = create_model(kind.__name__, __base__=Words, __doc__=kind.__doc__, **column_fields(kind, *state))
        fields[key] = (model, Field(None, description=first_line(kind)))
    return fields


def material_model() -> type[Words]:
    """Return the model of a material: its columns, where those that combine may say how."""
    rule = word_of(*COMBINE_RULES)
    fields = column_fields(Material, *MATERIAL_COLUMNS)
    for name in COMBINE_QUANTITIES:
        plain, field = fields[name]
        words: Fields = {"value": (plain, ...), "combine": (rule, ...)}
        combined = create_model(f"Combined{name.capitalize()}", __base__=Words, **words)
        fields[name] = (either(plain, combined), field)
    return create_model("Material", __base__=Words, __doc__="Surface and substance.", **fields)
