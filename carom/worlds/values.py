"""Types of values in world files, for pydantic: each reads what a file may say into SI numbers and has a schema."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, Any, get_args

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    TypeAdapter,
    WithJsonSchema,
    WrapValidator,
)
from pydantic_core import CoreSchema, core_schema

from carom.ecs.components.name import NAME_LENGTH
from carom.worlds.errors import WordError, shown
from carom.worlds.units import read_quantity

Vector3 = tuple[float, float, float]
EXPRESSION = {"type": "string", "pattern": r"\$\{", "description": "an expression: ${table.length / 2}"}
NAME = re.compile(r"[^\W\d][\w-]*")
ENTITY_NAME = re.compile(rf"{NAME.pattern}(?:\.[\w-]+|\[\d+(?:,\d+)*\])*")

LONGEST_FILE_NAME = 255  # characters, folders included


def _or_expression(node: dict[str, Any]) -> dict[str, Any]:
    return {"anyOf": [node, EXPRESSION]}


class Words(BaseModel):
    """A mapping of a file; unknown keys are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True)


@dataclass(frozen=True)
class In:
    """Marks a number, or a tuple of numbers, as one in ``unit``: ``Annotated[float, In("m", above=0.0)]``."""

    unit: str
    above: float | None = None
    least: float | None = None
    most: float | None = None

    def read(self, value: Any) -> float:
        """Return the number in SI; raise WordError."""
        return read_quantity(value, self.unit, above=self.above, least=self.least, most=self.most)

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Read each number by `read`; a list must have as many as the tuple."""
        number = core_schema.no_info_plain_validator_function(self.read)
        size = len(get_args(source))
        if not size:
            return number

        def sized(value: Any) -> Any:
            if not isinstance(value, list) or len(value) != size:
                accepted = f"numbers in {self.unit}"
                raise WordError(f"must be a list of {size} numbers", received=shown(value), accepted=accepted)
            return value

        items = core_schema.tuple_schema([number] * size)
        return core_schema.no_info_before_validator_function(sized, items, metadata={"size": size})

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Return a number or a text with a unit, or a list of them."""
        bounds = {"exclusiveMinimum": self.above, "minimum": self.least, "maximum": self.most}
        number = {"type": "number"} | {key: bound for key, bound in bounds.items() if bound is not None}
        text = {"type": "string", "pattern": r"^\s*[-+.0-9]", "description": "a number with a unit"}
        item = {"anyOf": [number, text, EXPRESSION], "x-unit": self.unit}
        inner: Any = schema
        while "size" not in inner.get("metadata", {}) and "schema" in inner:  # inside validators that come after
            inner = inner["schema"]
        size = inner.get("metadata", {}).get("size")
        return _or_expression({"type": "array", "items": item, "minItems": size, "maxItems": size}) if size else item


def either(plain: Any, other: Any, form: type = dict) -> Any:
    """Return the type of what is ``plain`` or, where the file has a mapping (or another ``form``), ``other``."""
    plain_adapter, other_adapter = TypeAdapter(plain), TypeAdapter(other)

    def choose(value: Any, handler: Any) -> Any:
        return (other_adapter if isinstance(value, form) else plain_adapter).validate_python(value)

    return Annotated[plain | other, WrapValidator(choose)]


def _read_name(value: Any) -> str:
    if not isinstance(value, str) or not NAME.fullmatch(value) or len(value) > NAME_LENGTH:
        accepted = f"a letter or _, then letters, digits, _ or -, at most {NAME_LENGTH} in all"
        raise WordError("is not a name", received=shown(value), accepted=accepted)
    return value


def _read_file_name(value: Any) -> str:
    if not isinstance(value, str):
        raise WordError("must be text", received=shown(value), accepted="text")
    if not 0 < len(value) <= LONGEST_FILE_NAME or not value.isprintable():
        accepted = f"at most {LONGEST_FILE_NAME} printable characters"
        raise WordError("is not the name of a file", received=shown(value), accepted=accepted)
    return value


def _read_flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise WordError("must be true or false", received=shown(value))
    return value


def _read_entity_name(value: Any) -> str:
    copy = isinstance(value, str) and len(value) <= NAME_LENGTH and ENTITY_NAME.fullmatch(value)
    return str(value) if copy else _read_name(value)


Name = Annotated[str, BeforeValidator(_read_name)]
EntityName = Annotated[str, BeforeValidator(_read_entity_name)]  # that of a copy too: rain[3,0,1]
FileName = Annotated[str, BeforeValidator(_read_file_name)]
Flag = Annotated[bool, BeforeValidator(_read_flag), WithJsonSchema(_or_expression({"type": "boolean"}))]


@dataclass(frozen=True)
class Whole:
    """Marks an integer of at least ``least`` and at most ``most``."""

    least: int
    most: int | None = None

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Refuse everything but integers in bounds."""

        def read(value: Any) -> int:
            fits = isinstance(value, int) and value >= self.least and (self.most is None or value <= self.most)
            if isinstance(value, bool) or not fits:
                accepted = f"{self.least} or more" if self.most is None else f"{self.least} to {self.most}"
                raise WordError("must be a whole number", received=shown(value), accepted=accepted)
            return int(value)

        return core_schema.no_info_plain_validator_function(read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Return an integer with its bound."""
        bounds = {"minimum": self.least} | ({} if self.most is None else {"maximum": self.most})
        return _or_expression({"type": "integer", **bounds})


Count = Annotated[int, Whole(1)]
Length = Annotated[float, In("m")]
Lengths = Annotated[Vector3, In("m")]


@dataclass(frozen=True)
class Text:
    """Marks a text of at most ``longest`` characters."""

    longest: int

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Refuse what is no text or longer, which would be cut off."""

        def read(value: Any) -> str:
            if not isinstance(value, str) or len(value) > self.longest:
                raise WordError("must be text", received=shown(value), accepted=f"at most {self.longest} characters")
            return value

        return core_schema.no_info_plain_validator_function(read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Return a text with its length."""
        return {"type": "string", "maxLength": self.longest}


def word_of(*choices: str) -> Any:
    """Return the type of one of some words."""

    def read(value: Any) -> str:
        if value not in choices:
            raise WordError("unknown word", received=shown(value), accepted=", ".join(choices))
        return str(value)

    return Annotated[str, BeforeValidator(read), WithJsonSchema(_or_expression({"enum": list(choices)}))]
