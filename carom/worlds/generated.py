"""Models made from the registries: what components, shapes, force laws and settings declare is not written twice."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from typing import Annotated, Any, Literal, get_args, get_origin, get_type_hints

import numpy as np
from pydantic import Field, TypeAdapter, create_model

from carom.ecs import Material
from carom.ecs.column import Column
from carom.ecs.component import Component
from carom.ecs.errors import DeclarationError
from carom.systems.actions import ACTIONS, Spawn
from carom.systems.extensions import origin
from carom.systems.forces import LAWS
from carom.systems.joints import JOINTS
from carom.systems.materials import COMBINE_QUANTITIES, COMBINE_RULES, MATERIAL_COLUMNS
from carom.systems.own_components import components_of_files
from carom.systems.settings import MOST_SUBSTEPS, MOST_THREADS, Settings
from carom.systems.shapes import SHAPES
from carom.worlds.color import ColorWord
from carom.worlds.errors import WordError
from carom.worlds.generators import GENERATORS
from carom.worlds.geometry import GEOMETRY_WORDS
from carom.worlds.rotation import RotationWord
from carom.worlds.units import parse_unit
from carom.worlds.values import Flag, In, Text, Whole, Words, either, word_of

SPECIAL = {"rotation": RotationWord, "principal_axes": RotationWord, "color": ColorWord}
SETTING_UNITS = {"dt": "s", "gravity": "m/s2", "hit_speed": "m/s"}
SETTING_BOUNDS: dict[str, dict[str, float]] = {"dt": {"above": 0.0}, "hit_speed": {"above": 0.0}}
SETTING_WHOLE: dict[str, tuple[int, int | None]] = {
    "substeps": (1, MOST_SUBSTEPS),
    "dimensions": (2, 3),
    "threads": (1, MOST_THREADS),
}
STEP_WORDS = ("dt", "substeps", "integrator", "threads", "sleeping")
Fields = dict[str, Any]


def numbers(width: int, mark: In) -> Any:
    """Return the type of one number or of a list of ``width``."""
    return Annotated[float if width == 1 else tuple.__class_getitem__((float,) * width), mark]


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
    return Field(default, description=_description(column.doc, column.unit))


def _description(doc: str, unit: str) -> str:
    return doc if unit == "1" else f"{doc} ({unit})"


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
        fields[key] = (model, Field(None, description=_first_line(kind)))
    return fields


def parameter_model(kind: type[Any]) -> type[Words]:
    """Return the model of a dataclass whose fields are declared: a shape, a force law or a joint, or a part of one."""
    if kind.__dict__.get("key") in GEOMETRY_WORDS:
        return GEOMETRY_WORDS[kind.key]
    hints = get_type_hints(kind)
    fields: Fields = {}
    for field in dataclasses.fields(kind):
        unit, doc = field.metadata.get("unit", "1"), field.metadata.get("doc", field.name)
        kept = ... if field.default is dataclasses.MISSING else field.default
        fields[field.name] = (_field_type(hints[field.name], field), Field(kept, description=_description(doc, unit)))
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
    return _hinted(hint, declared.get("unit", "1"), width=declared.get("width", 1), **bounds)


def _hinted(hint: Any, unit: str, *, width: int = 1, whole: tuple[int, int | None] = (0, None), **bounds: Any) -> Any:
    if get_origin(hint) is Literal:
        return word_of(*get_args(hint))
    if hint is bool:
        return Flag
    if hint is int:
        return Annotated[int, Whole(*whole)]
    return numbers(width, In(unit, **bounds))


def shape_fields() -> Fields:
    """Return one optional field per shape."""
    kinds = sorted(SHAPES.items())
    return {key: (parameter_model(kind), Field(None, description=_first_line(kind))) for key, kind in kinds}


def generator_fields() -> Fields:
    """Return one optional field per generator."""
    return {key: (kind, Field(None, description=_first_line(kind))) for key, kind in GENERATORS.items()}


def joint_fields() -> Fields:
    """Return one optional field per kind of joint."""
    kinds = sorted(JOINTS.items())
    return {key: (parameter_model(kind), Field(None, description=_first_line(kind))) for key, kind in kinds}


def action_fields() -> Fields:
    """Return one optional field per action of events but `Spawn`; one that takes names only is a list of them."""
    fields: Fields = {}
    for key, kind in ACTIONS.items():
        if kind is not Spawn:
            names_only = [field.name for field in dataclasses.fields(kind)] == ["entities"]  # type: ignore[arg-type]
            model: Any = list[str] if names_only else parameter_model(kind)
            fields[key] = (model, Field(None, description=_first_line(kind)))
    return fields


def law_fields() -> Fields:
    """Return one optional field per force law."""
    return {key: (parameter_model(kind), Field(None, description=_first_line(kind))) for key, kind in LAWS.items()}


def _first_line(kind: type[Any]) -> str:
    return (kind.__doc__ or "").strip().split("\n")[0]


def setting_fields(*, in_step: bool) -> Fields:
    """Return the fields of `Settings` that stand under ``step``, or those at the top of a file."""
    hints = get_type_hints(Settings)
    fields: Fields = {}
    for field in dataclasses.fields(Settings):
        if (field.name in STEP_WORDS) is in_step:
            unit, bounds = SETTING_UNITS.get(field.name, "1"), SETTING_BOUNDS.get(field.name, {})
            width, whole = len(get_args(hints[field.name])) or 1, SETTING_WHOLE.get(field.name, (0, None))
            kind = _hinted(hints[field.name], unit, width=width, whole=whole, **bounds)
            fields[field.name] = (kind, Field(field.default, description=_description(field.metadata["doc"], unit)))
    return fields


def setting_types() -> dict[str, TypeAdapter[Any]]:
    """Return what reads the value of each setting by its name, wherever it stands in a file."""
    fields = setting_fields(in_step=True) | setting_fields(in_step=False)
    declared: dict[str, Any] = {name: Annotated[kind, field] for name, (kind, field) in fields.items()}
    return {name: TypeAdapter(kind) for name, kind in declared.items()}


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
