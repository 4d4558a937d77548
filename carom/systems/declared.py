"""Declarations of what joints and regions take beside plain numbers, and reading words of files or Python by them."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any, TypeVar

import numpy as np

from carom.systems.parameters import WordFault, number_fault, unknown_keys

T = TypeVar("T", bound="Stated")
Steps = tuple[str, ...]


class Stated:
    """What words state: a dataclass of declared fields that may find further faults in how they go together."""

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Yield which of its words is wrong (none: all of them together), and what about it."""
        yield from ()


def whom(*, doc: str) -> Any:
    """Declare who is held: a name or a handle, the world where it is left out."""
    return dataclasses.field(default=None, metadata={"entity": True, "doc": doc})


def called(*, doc: str) -> Any:
    """Declare names of entities, or patterns that mean several."""
    return dataclasses.field(metadata={"names": True, "doc": doc})


def bounds(*, unit: str, doc: str) -> Any:
    """Declare a lower and an upper bound, none where they are left out."""
    return dataclasses.field(default=None, metadata={"unit": unit, "doc": doc, "width": 2, "ordered": True})


def span(*, unit: str, doc: str, default: Any, above: float | None = None, least: float | None = None) -> Any:
    """Declare one number, or a least and a greatest."""
    bound = {"above": above, "least": least}
    return dataclasses.field(default=default, metadata={"unit": unit, "doc": doc, "width": 2, "span": True, **bound})


def tint(*, doc: str, default: Any = None) -> Any:
    """Declare a colour: red, green, blue and, where it is not 1, alpha, each in 0..1."""
    return dataclasses.field(default=default, metadata={"color": True, "doc": doc})


def choice(words: tuple[str, ...], *, doc: str, default: str) -> Any:
    """Declare one of some words."""
    return dataclasses.field(default=default, metadata={"choices": words, "doc": doc})


def numbers(count: int, *, doc: str, default: Any) -> Any:
    """Declare so many numbers."""
    return dataclasses.field(default=default, metadata={"unit": "1", "doc": doc, "width": count})


def direction(*, doc: str) -> Any:
    """Declare a direction, a vector of any length but 0."""
    return dataclasses.field(default=None, metadata={"unit": "1", "doc": doc, "width": 3, "directed": True})


def flag(*, doc: str) -> Any:
    """Declare something that is so or not, and not so by default."""
    return dataclasses.field(default=False, metadata={"doc": doc})


def part(kind: type[Stated], *, doc: str, words: tuple[str, ...] = (), default: Any = None) -> Any:
    """Declare a mapping with the words of ``kind``, or one of some ``words`` in its place."""
    return dataclasses.field(default=default, metadata={"part": kind, "words": words, "doc": doc})


def read_words(kind: type[T], words: Any, steps: Steps, faults: list[WordFault]) -> T | None:
    """Return what words state of a declared kind; None where anything is wrong, all of which is added to ``faults``.

    ``steps`` say where the words stand. A word of None is as good as none.
    """
    fields = {field.name: field for field in dataclasses.fields(kind)}  # type: ignore[arg-type]
    if not isinstance(words, Mapping):
        faults.append(WordFault(steps, "must be a mapping", repr(words), ", ".join(fields)))
        return None
    before = len(faults)
    faults += unknown_keys(steps, words, fields)
    stated = {name: value for name, value in words.items() if value is not None}
    values: dict[str, Any] = {}
    for name, field in fields.items():
        if name in stated:
            values[name] = _read(field, stated[name], (*steps, name), faults)
        elif field.default is dataclasses.MISSING:
            faults.append(WordFault((*steps, name), "is missing", accepted=field.metadata["doc"]))
    if len(faults) > before:
        return None
    made = kind(**values)
    faults += [WordFault((*steps, *further), what) for further, what in made.faults()]
    return made if len(faults) == before else None


def _read(field: dataclasses.Field[Any], value: Any, steps: Steps, faults: list[WordFault]) -> Any:
    declared = field.metadata
    if "part" in declared:
        if not (isinstance(value, str) and declared["words"]):
            return read_words(declared["part"], value, steps, faults)
        if value not in declared["words"]:
            faults.append(WordFault(steps, "unknown word", repr(value), ", ".join(declared["words"])))
        return value
    if "entity" in declared:
        return value
    if "choices" in declared:
        if value not in declared["choices"]:
            faults.append(WordFault(steps, "unknown word", repr(value), ", ".join(declared["choices"])))
        return value
    if "color" in declared:
        return _read_color(value, steps, faults)
    if declared.get("span") and not isinstance(value, (list, tuple, np.ndarray)):
        wrong = number_fault({**declared, "width": None}, value)
        faults += [WordFault(steps, wrong)] if wrong else []
        return (value, value)
    if "names" in declared:
        if not isinstance(value, (list, tuple)) or not all(isinstance(name, str) for name in value):
            faults.append(WordFault(steps, "must be a list of names", repr(value)))
            return value
        return tuple(value)
    if "unit" not in declared:
        if not isinstance(value, bool):
            faults.append(WordFault(steps, "must be true or false", repr(value)))
        return value
    wrong = "" if value is field.default else number_fault(declared, value)
    if wrong:
        faults.append(WordFault(steps, wrong))
    elif declared.get("ordered") and value[0] > value[1]:
        order = f"[{value[0]:g}, {value[1]:g}] {declared['unit']}"
        faults.append(WordFault(steps, "the lower limit must not be above the upper", order, "[lower, upper]"))
    elif declared.get("span") and value[0] > value[1]:
        order = f"[{value[0]:g}, {value[1]:g}] {declared['unit']}"
        faults.append(WordFault(steps, "the least must not be above the greatest", order, "[least, greatest]"))
    elif declared.get("directed") and not any(value):
        faults.append(WordFault(steps, "must have a direction", f"[{', '.join(f'{number:g}' for number in value)}]"))
    return tuple(float(number) for number in value) if "width" in declared and not wrong else value


def _read_color(value: Any, steps: Steps, faults: list[WordFault]) -> Any:
    parts = np.asarray(value) if isinstance(value, (list, tuple, np.ndarray)) else np.zeros(0)
    if parts.shape not in ((3,), (4,)) or parts.dtype.kind not in "fiu" or not ((parts >= 0) & (parts <= 1)).all():
        faults.append(WordFault(steps, "is not a colour", repr(value), "3 or 4 numbers in 0..1"))
        return value
    return tuple(float(part) for part in (*parts, 1.0)[:4])
