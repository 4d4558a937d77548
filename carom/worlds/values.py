"""Types of values in world files, for pydantic: each reads what a file may say into SI numbers and has a schema."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, TypeAdapter, WithJsonSchema, WrapValidator

from carom.ecs.components.name import NAME_LENGTH
from carom.worlds.errors import ValueFault, shown
from carom.worlds.units import read_quantity

NAME = re.compile(r"[^\W\d][\w-]*")


class Words(BaseModel):
    """A mapping of a file; unknown keys are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True)


def quantity(unit: str, *, above: float | None = None, least: float | None = None) -> Any:
    """Return the type of a number in ``unit``, with bounds."""
    number: dict[str, Any] = {"type": "number"}
    number |= {} if above is None else {"exclusiveMinimum": above}
    number |= {} if least is None else {"minimum": least}
    text = {"type": "string", "pattern": r"^\s*[-+.0-9]", "description": f"a number with a unit; plain numbers are in {unit}"}
    schema = {"anyOf": [number, text], "x-unit": unit}
    read = BeforeValidator(lambda value: read_quantity(value, unit, above=above, least=least))
    return Annotated[float, read, WithJsonSchema(schema)]


def vector(size: int, unit: str, *, above: float | None = None, least: float | None = None) -> Any:
    """Return the type of a list of ``size`` numbers in ``unit``."""
    item = quantity(unit, above=above, least=least)
    return Annotated[tuple.__class_getitem__((item,) * size), BeforeValidator(_sized(size, unit))]


def _sized(size: int, unit: str) -> Callable[[Any], Any]:
    def check(value: Any) -> Any:
        if not isinstance(value, list) or len(value) != size:
            raise ValueFault(f"must be a list of {size}", received=shown(value), accepted=f"{size} numbers in {unit}")
        return value

    return check


def either(plain: Any, mapping: Any) -> Any:
    """Return the type of what is ``plain`` or, where the file has a mapping, ``mapping``; messages name no third thing."""
    plain_adapter, mapping_adapter = TypeAdapter(plain), TypeAdapter(mapping)

    def choose(value: Any, handler: Any) -> Any:
        return (mapping_adapter if isinstance(value, dict) else plain_adapter).validate_python(value)

    return Annotated[plain | mapping, WrapValidator(choose)]


def _read_name(value: Any) -> str:
    if not isinstance(value, str) or not NAME.fullmatch(value) or len(value) > NAME_LENGTH:
        accepted = f"a letter or _, then letters, digits, _ or -, at most {NAME_LENGTH} in all"
        raise ValueFault("is not a name", received=shown(value), accepted=accepted)
    return value


Name = Annotated[str, BeforeValidator(_read_name)]


def _read_flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise ValueFault("must be true or false", received=shown(value))
    return value


Flag = Annotated[bool, BeforeValidator(_read_flag)]


def whole_number(least: int) -> Any:
    """Return the type of an integer of at least ``least``."""

    def read(value: Any) -> int:
        if isinstance(value, bool) or not isinstance(value, int) or value < least:
            raise ValueFault("must be a whole number", received=shown(value), accepted=f"{least} or more")
        return value

    return Annotated[int, BeforeValidator(read), Field(ge=least)]


def word_of(*choices: str) -> Any:
    """Return the type of one of some words."""

    def read(value: Any) -> str:
        if value not in choices:
            raise ValueFault("is not one of its words", received=shown(value), accepted=", ".join(choices))
        return str(value)

    return Annotated[str, BeforeValidator(read), WithJsonSchema({"enum": list(choices)})]
